# lozenge_component(NAME [ROOMS folders...] [LINK targets...] [PRIVATE_LINK targets...] [TEST_LINK targets...])
#
# The .cpp files of the current folder and of the ROOMS below it become the library lozenge_NAME; the *_test.cpp among
# them become the program NAME_tests, whose tests are listed when it is built and run by CTest one by one. The
# *_fixtures.cpp become the library lozenge_NAME_fixtures, which the tests of this component and of later ones link, and
# nothing else. Every component has fmt, for its messages.
function(lozenge_component name)
  cmake_parse_arguments(arg "" "" "ROOMS;LINK;PRIVATE_LINK;TEST_LINK" ${ARGN})
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "lozenge_component(${name}): don't know ${arg_UNPARSED_ARGUMENTS}")
  endif()
  set(patterns *.cpp)
  foreach(room ${arg_ROOMS})
    list(APPEND patterns ${room}/*.cpp)
  endforeach()
  file(GLOB sources CONFIGURE_DEPENDS ${patterns})
  set(tests ${sources})
  list(FILTER tests INCLUDE REGEX "_test\\.cpp$")
  set(fixtures ${sources})
  list(FILTER fixtures INCLUDE REGEX "_fixtures\\.cpp$")
  list(FILTER sources EXCLUDE REGEX "_(test|fixtures)\\.cpp$")
  if(NOT sources)
    return()
  endif()

  add_library(lozenge_${name} STATIC ${sources})
  add_library(lozenge::${name} ALIAS lozenge_${name})
  set_target_properties(lozenge_${name} PROPERTIES EXPORT_NAME ${name})
  set_property(GLOBAL APPEND PROPERTY lozenge_components lozenge_${name})
  # Our own files say "formats/domain/domain.h"; users of an installed library may say <lozenge/formats/domain/domain.h>.
  target_include_directories(lozenge_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                    $<INSTALL_INTERFACE:include>
                                                    $<INSTALL_INTERFACE:include/lozenge>)
  target_compile_features(lozenge_${name} PUBLIC cxx_std_20)
  target_link_libraries(lozenge_${name} PUBLIC ${arg_LINK} PRIVATE ${arg_PRIVATE_LINK} fmt::fmt)
  lozenge_compile_options(lozenge_${name})
  lozenge_use_precompiled(lozenge_${name} headers)

  if(LOZENGE_BUILD_TESTS AND fixtures)
    add_library(lozenge_${name}_fixtures STATIC ${fixtures})
    get_property(all_fixtures GLOBAL PROPERTY lozenge_fixtures)
    target_link_libraries(lozenge_${name}_fixtures PUBLIC lozenge_${name} ${all_fixtures} GTest::gtest
                                                  PRIVATE ${arg_PRIVATE_LINK} fmt::fmt)
    lozenge_compile_options(lozenge_${name}_fixtures)
    lozenge_use_precompiled(lozenge_${name}_fixtures test_headers)
    lozenge_compile_quickly(lozenge_${name}_fixtures)
    set_property(GLOBAL APPEND PROPERTY lozenge_fixtures lozenge_${name}_fixtures)
  endif()

  if(LOZENGE_BUILD_TESTS AND tests)
    get_property(all_fixtures GLOBAL PROPERTY lozenge_fixtures)
    add_executable(${name}_tests ${tests})
    target_link_libraries(${name}_tests PRIVATE lozenge_${name} ${all_fixtures} ${arg_PRIVATE_LINK} ${arg_TEST_LINK}
                                                fmt::fmt GTest::gtest_main)
    lozenge_compile_options(${name}_tests)
    lozenge_use_precompiled(${name}_tests test_headers)
    lozenge_compile_quickly(${name}_tests)
    lozenge_discover_tests(${name}_tests ${name})
  endif()
endfunction()

# lozenge_discover_tests(TARGET PREFIX): CTest knows each GoogleTest of the program as PREFIX.Suite.Name. Tests run side by
# side, so each keeps to one core, and programs that it starts to one thread: many threads would only wait for each other.
# Those that compare numbers of threads say so in their name, and get two.
function(lozenge_discover_tests target prefix)
  set(options TEST_PREFIX "${prefix}." DISCOVERY_TIMEOUT 60 NO_PRETTY_VALUES)
  gtest_discover_tests(${target} ${options} TEST_FILTER "-*Thread*" PROPERTIES PROCESSOR_AFFINITY ON)
  gtest_discover_tests(${target} ${options} TEST_FILTER "*Thread*" TEST_LIST ${target}_threads PROPERTIES PROCESSORS 2)
endfunction()

include(GoogleTest)
