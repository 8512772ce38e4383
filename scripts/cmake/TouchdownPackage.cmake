# `make package` builds a Debian package of the program, the estimator library, the Python package and the
# models. It depends on the packages of the libraries that they link, and of the programs and files that
# they open at run time.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME touchdown)
set(CPACK_PACKAGE_CONTACT "the maintainers of ${PROJECT_NAME}")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL OFF)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# gnuplot draws figures. OSMesa or Mesa's EGL renders films without a display, FFmpeg encodes them.
string(REGEX MATCH "^[0-9]+" libavformat_major "${FFMPEG_libavformat_VERSION}")
set(CPACK_DEBIAN_PACKAGE_DEPENDS
    "gnuplot-nox | gnuplot-qt | gnuplot-x11, fonts-dejavu-core, libosmesa6 | libegl-mesa0, libavformat${libavformat_major}, python3, python3-numpy")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libeigen3-dev, g++")
include(CPack)
