# The library of Fourier transforms behind src/tabor/spectral (docs/decisions/031-libraries-of-transforms.md):
#
#   TABOR_FFT=fftw    FFTW 3 of the system; binaries then fall under the GNU General Public License
#   TABOR_FFT=ducc0   ducc0, under the BSD licence: its sources of TABOR_DUCC0, or of PyPI where that is empty
#
# Sets TABOR_FFT_LIBRARIES, which the module links.
set(TABOR_FFT fftw CACHE STRING "Library of Fourier transforms: fftw or ducc0")
set_property(CACHE TABOR_FFT PROPERTY STRINGS fftw ducc0)
if(NOT TABOR_FFT MATCHES "^(fftw|ducc0)$")
  message(FATAL_ERROR "TABOR_FFT is '${TABOR_FFT}'; it can be fftw or ducc0")
endif()
set(TABOR_DUCC0 "" CACHE PATH "Folder src of ducc0's source archive (empty: taken from PyPI if needed)")

# Lets pip download ducc0's source archive from where it takes packages, and unpacks it, once for a build folder;
# `folder` is then its folder src.
function(tabor_download_ducc0 folder)
  set(version 0.42.0)
  set(digest 4e11c59b53a43355b053aebb2a62ee16eebeed026575f7d216cf09d437ce52ef)  # SHA-256
  set(place ${PROJECT_BINARY_DIR}/ducc0)
  set(archive ${place}/ducc0-${version}.tar.gz)
  set(${folder} ${place}/ducc0-${version}/src PARENT_SCOPE)
  if(EXISTS ${place}/ducc0-${version}/src)
    return()
  endif()
  file(WRITE ${place}/requirements.txt "ducc0==${version} --hash=sha256:${digest}\n")
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  set(problem "no pip was found")
  # Where pip runs this build, it sets PYTHONPATH so that its interpreter does not find pip, and a tool such as build
  # makes an environment that has none: then the system's interpreter downloads.
  foreach(python ${Python3_EXECUTABLE} /usr/bin/python3)
    if(EXISTS ${archive})
      break()
    endif()
    message(STATUS "Downloading ducc0 ${version} with ${python}")
    execute_process(
      COMMAND ${CMAKE_COMMAND} -E env --unset=PYTHONPATH
              ${python} -m pip download --quiet --no-deps --no-binary ducc0 --dest ${place} -r ${place}/requirements.txt
      OUTPUT_VARIABLE problem ERROR_VARIABLE problem)
  endforeach()
  if(NOT EXISTS ${archive})
    message(FATAL_ERROR "TABOR_FFT=ducc0 compiles sources of ducc0 ${version}, and pip cannot download them:\n${problem}\n"
      "Unpack its source archive and say -DTABOR_DUCC0=FOLDER/ducc0-${version}/src, or take FFTW: -DTABOR_FFT=fftw")
  endif()
  file(ARCHIVE_EXTRACT INPUT ${archive} DESTINATION ${place})
endfunction()

# The licence of the transforms stands only at the head of their files: LICENSE of the archive is that of its other parts.
function(tabor_extract_ducc0_licence source file)
  file(READ ${source} text)
  string(REGEX MATCH "Copyright .*SUCH DAMAGE[.]" text "${text}")
  if(NOT text MATCHES "SPDX-License-Identifier: BSD-3-Clause OR GPL-2.0-or-later" OR NOT text MATCHES "Redistributions in binary form")
    message(FATAL_ERROR "${source} does not open with the BSD licence, under which tabor takes it")
  endif()
  string(REGEX REPLACE "\n(/[*]|[*]/)[^\n]*" "" text "${text}")
  file(CONFIGURE OUTPUT ${file} CONTENT "The Fourier transforms of ducc0, https://gitlab.mpcdf.mpg.de/mtr/ducc\n\n@text@\n" @ONLY)
endfunction()

# Makes the target tabor_ducc0, with the folder of the sources as its include directory, and the text of the licence.
function(tabor_find_ducc0)
  set(folder ${TABOR_DUCC0})
  if(NOT folder)
    tabor_download_ducc0(folder)
  endif()
  if(NOT EXISTS ${folder}/ducc0/fft/fft1d_impl.h)
    message(FATAL_ERROR "TABOR_DUCC0 is '${folder}', which has no ducc0/fft/fft1d_impl.h; name the folder src of ducc0's source archive")
  endif()
  set(version "of an unknown version")
  if(EXISTS ${folder}/../PKG-INFO)
    file(STRINGS ${folder}/../PKG-INFO version REGEX "^Version: " LIMIT_COUNT 1)
    string(REPLACE "Version: " "" version "${version}")
  endif()
  add_library(tabor_ducc0 INTERFACE)
  target_include_directories(tabor_ducc0 SYSTEM INTERFACE ${folder})
  target_compile_definitions(tabor_ducc0 INTERFACE TABOR_FFT_DUCC0 TABOR_DUCC0_VERSION="${version}")
  tabor_extract_ducc0_licence(${folder}/ducc0/fft/fft1d_impl.h ${PROJECT_BINARY_DIR}/ducc0/LICENSE.ducc0)
endfunction()

if(TABOR_FFT STREQUAL "ducc0")
  tabor_find_ducc0()
  set(TABOR_FFT_LIBRARIES $<BUILD_INTERFACE:tabor_ducc0>)  # headers alone: nothing that users of the library need
else()
  set(TABOR_FFT_LIBRARIES PkgConfig::FFTW PkgConfig::FFTWF)
endif()
