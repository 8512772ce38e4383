#pragma once

namespace touchdown {

/// The one style of all figures, written beside them as `style.gp`. Line colours are Okabe and
/// Ito's, heatmaps use cividis: both can be told apart by colour-blind readers, and cividis stays
/// in order in grey print.
inline constexpr const char* gnuplot_style =
    R"(# The style of all figures. Change it here and draw them again.
# Text is never markup, so that names may contain _ and ^.
terminal(format, width, height) = \
    format eq 'png' ? sprintf("set terminal pngcairo noenhanced font 'DejaVu Sans,10' size %d,%d background rgb 'white'", width, height) : \
    format eq 'svg' ? sprintf("set terminal svg noenhanced font 'DejaVu Sans,10' fontscale 1.333 size %d,%d dynamic background rgb 'white'", width, height) : \
    sprintf("set terminal pdfcairo noenhanced font 'DejaVu Sans,10' size %.2fin,%.2fin", width / 96.0, height / 96.0)
set encoding utf8
set linetype 1 lc rgb '#0072b2' lw 1.8 pt 7 ps 0.7
set linetype 2 lc rgb '#d55e00' lw 1.8 pt 5 ps 0.7 dt (8,3)
set linetype 3 lc rgb '#009e73' lw 1.8 pt 9 ps 0.8 dt (3,2)
set linetype 4 lc rgb '#cc79a7' lw 1.8 pt 13 ps 0.8 dt (8,3,2,3)
set linetype 5 lc rgb '#e69f00' lw 1.8 pt 11 ps 0.8 dt (12,4)
set linetype 6 lc rgb '#56b4e9' lw 1.8 pt 3 ps 0.8 dt (2,3)
set linetype 7 lc rgb '#22262b' lw 1.4 pt 1 ps 0.8 dt (1,2)
set linetype 8 lc rgb '#8c6d31' lw 1.8 pt 2 ps 0.8 dt (16,3,2,3)
set linetype cycle 8
set palette defined (0 '#00224e', 1 '#123570', 2 '#3b496c', 3 '#575d6d', 4 '#707173', 5 '#8a8678', 6 '#a59c74', 7 '#c3b369', 8 '#e1cc55', 9 '#fee838')
set border 3 lc rgb '#40464e' lw 0.8
set tics nomirror out scale 0.5 textcolor rgb '#22262b'
set grid back lc rgb '#dfe3e6' lw 0.6 dt 1
set key noautotitle samplen 2.5 spacing 1.1 textcolor rgb '#22262b'
set style fill solid 1.0 noborder
set datafile separator tab
set datafile missing 'NaN'
set minussign
)";

}  // namespace touchdown
