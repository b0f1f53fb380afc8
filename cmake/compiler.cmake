# How our code is compiled.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

# The libraries are static, but may end in somebody's shared one.
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Release, Debug or RelWithDebInfo" FORCE)
endif()

find_program(LOZENGE_CCACHE ccache)
mark_as_advanced(LOZENGE_CCACHE)
if(LOZENGE_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # It takes precompiled headers where it need not look into them for macros and times.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${LOZENGE_CCACHE})
endif()

# Every x86 processor since 2009 runs x86-64-v2 (SSE4.1 has the rounding instructions that plain x86-64 lacks).
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$")
  set(default_architecture x86-64-v2)
endif()
set(LOZENGE_ARCHITECTURE "${default_architecture}" CACHE STRING "Value of -march; empty for the compiler's own choice")

# lozenge_compile_options(TARGET): for our targets alone.
function(lozenge_compile_options target)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Werror
    # The same source and input give the same bits: nothing is fused or reordered. (errno is never read, so that costs nothing.)
    -ffp-contract=off -fno-math-errno
    $<$<BOOL:${LOZENGE_ARCHITECTURE}>:-march=${LOZENGE_ARCHITECTURE}>)
endfunction()

# lozenge_compile_quickly(TARGET...): for code that is run for an instant: what is gained by optimizing it is less than what
# that takes. (-O1 computes the same: nothing depends on the level but time.)
function(lozenge_compile_quickly)
  foreach(target ${ARGV})
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endforeach()
endfunction()

# The same for some files of a component: those that read or write a document of a few kilobytes, by libraries of templates.
function(lozenge_compile_files_quickly)
  set_source_files_properties(${ARGV} PROPERTIES COMPILE_OPTIONS $<$<CONFIG:Release>:-O1>)
endfunction()
