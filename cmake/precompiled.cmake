# Headers that nearly every file includes are parsed once, and not two hundred times: half a second for each.
#
# Every file includes what it uses all the same, and must compile without: with CMAKE_DISABLE_PRECOMPILE_HEADERS, as the
# presets `fuzz` and `tidy` set it.
option(CMAKE_DISABLE_PRECOMPILE_HEADERS "Parse each header in each file that includes it" OFF)
# Clang wants the same macros in all files that share what was precompiled.
if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
endif()

# lozenge_precompile(NAME HEADERS... LINK targets...): the library lozenge_NAME, which holds nothing but precompiled headers.
function(lozenge_precompile name)
  cmake_parse_arguments(arg "" "" "HEADERS;LINK" ${ARGN})
  set(source ${PROJECT_BINARY_DIR}/lozenge_${name}.cpp)
  if(NOT EXISTS ${source})
    file(WRITE ${source} "")
  endif()
  add_library(lozenge_${name} OBJECT ${source})
  target_link_libraries(lozenge_${name} PRIVATE ${arg_LINK})
  lozenge_compile_options(lozenge_${name})
  target_precompile_headers(lozenge_${name} PRIVATE ${arg_HEADERS})
endfunction()

# lozenge_use_precompiled(TARGET NAME)
function(lozenge_use_precompiled target name)
  target_precompile_headers(${target} REUSE_FROM lozenge_${name})
  # The compiler's cache looks into what was precompiled; programs are compiled as libraries, or they couldn't share it.
  target_compile_options(${target} PRIVATE -fpch-preprocess -fPIC)
endfunction()

set(kCommonHeaders <algorithm> <array> <cmath> <cstdint> <filesystem> <fstream> <functional> <limits> <map> <memory> <numeric>
                   <optional> <set> <span> <string> <string_view> <unordered_map> <utility> <vector>
                   <Imath/ImathMatrix.h> <Imath/ImathVec.h> <fmt/format.h>)
lozenge_precompile(headers HEADERS ${kCommonHeaders} LINK Imath::Imath fmt::fmt)
if(LOZENGE_BUILD_TESTS)
  lozenge_precompile(test_headers
    HEADERS ${kCommonHeaders} <random> <gtest/gtest.h>
    LINK Imath::Imath fmt::fmt GTest::gtest)
  lozenge_compile_quickly(lozenge_test_headers)
endif()
