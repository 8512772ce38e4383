#!/usr/bin/env bash
# on_display.sh SCRIPT COMMAND...: runs COMMAND on a display of its own, and SCRIPT beside it once its window
# is drawn. SCRIPT is bash that sends keys and mouse motion with xdotool. Exits like COMMAND.
set -euo pipefail
script="$1"
shift

number="$(mktemp)"
Xvfb -displayfd 3 -screen 0 1280x720x24 3>"$number" 2>/dev/null &
server=$!
trap 'kill "$server" 2>/dev/null; rm -f "$number"' EXIT
for ((i = 0; i < 100; ++i)); do
  [[ -s "$number" ]] && break
  sleep 0.1
done
DISPLAY=":$(cat "$number")"
export DISPLAY

# picture SIZE X Y: this part of the display, as bytes of red, green and blue.
picture() {
  ffmpeg -loglevel error -f x11grab -draw_mouse 0 -video_size "$1" -i "$DISPLAY+$2,$3" -frames:v 1 -f rawvideo -pix_fmt rgb24 -
}
# until_shown X Y RRGGBB: waits until a pixel has this colour. A busy machine may need seconds for a picture.
until_shown() {
  local colour
  for ((i = 0; i < 300; ++i)); do
    colour="$(picture 2x2 "$1" "$2" | od -An -tx1 -N3 | tr -d ' ')"
    [[ "$colour" == "$3" ]] && return
    sleep 0.1
  done
  echo "at $1 $2: expected the colour $3, found $colour" >&2
}
# until_written FILE TEXT: waits until the file has the text.
until_written() {
  for ((i = 0; i < 300; ++i)); do
    grep -qF "$2" "$1" && return
    sleep 0.1
  done
  echo "$1: expected the text '$2'" >&2
}

# In a sanitizer's build: the display's driver, unloaded when a window closes, keeps 240 bytes.
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0"
"$@" &
program=$!
# Without a window manager, keys go to the window under the mouse.
timeout 60 xdotool search --sync --onlyvisible --name '^touchdown: ' >/dev/null
xdotool mousemove 300 400
for ((i = 0; i < 300; ++i)); do # an empty display is black
  (($(picture 600x400 0 0 | tr -d '\0' | wc -c) > 0)) && break
  sleep 0.1
done
eval "$script"
wait "$program"
