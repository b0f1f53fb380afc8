# lozenge_add_assets(TARGET name SOURCES assets... [OPTIONS options...] [OUTPUT_DIRECTORY folder] [ALL])
#
# The target `name` builds each of the assets with `lozenge build`: NAME.glb and all that comes with it, in `folder` (else the
# current binary folder). An asset is built again where it, a buffer or an image that it names, or the program is newer; what
# that comes to is taken from a cache, where OPTIONS has one (--cache, or LOZENGE_CACHE is set). ALL: as a part of the default
# target. The list of all .glb is the target's property LOZENGE_ASSETS.
#
# The program is LOZENGE_PROGRAM, which find_package(lozenge) finds.

cmake_policy(PUSH)
cmake_policy(VERSION 3.22)  # that of each function here: CMP0116, paths in depfiles

function(lozenge_add_assets)
  cmake_parse_arguments(PARSE_ARGV 0 arg "ALL" "TARGET;OUTPUT_DIRECTORY" "SOURCES;OPTIONS")
  if(arg_UNPARSED_ARGUMENTS OR NOT arg_TARGET OR NOT arg_SOURCES)
    message(FATAL_ERROR "lozenge_add_assets wants TARGET and SOURCES, and knows OPTIONS, OUTPUT_DIRECTORY and ALL")
  endif()
  if(NOT LOZENGE_PROGRAM)
    message(FATAL_ERROR "lozenge_add_assets: LOZENGE_PROGRAM isn't set; find_package(lozenge) sets it")
  endif()
  if(NOT arg_OUTPUT_DIRECTORY)
    set(arg_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  endif()
  get_filename_component(folder ${arg_OUTPUT_DIRECTORY} ABSOLUTE BASE_DIR ${CMAKE_CURRENT_BINARY_DIR})
  set(outputs)
  foreach(source ${arg_SOURCES})
    get_filename_component(source ${source} ABSOLUTE)
    get_filename_component(name ${source} NAME_WLE)
    set(output ${folder}/${name}.glb)
    if(output IN_LIST outputs)
      message(FATAL_ERROR "lozenge_add_assets: two sources would become ${output}; give them targets and folders of their own")
    endif()
    set(depfile ${CMAKE_CURRENT_BINARY_DIR}/${arg_TARGET}.${name}.d)
    add_custom_command(
      OUTPUT ${output}
      COMMAND ${LOZENGE_PROGRAM} build ${source} -o ${folder} --quiet --depfile ${depfile} ${arg_OPTIONS} > /dev/null
      DEPENDS ${source} ${LOZENGE_PROGRAM}
      DEPFILE ${depfile}
      COMMENT "Building the asset ${name}"
      VERBATIM)
    list(APPEND outputs ${output})
  endforeach()
  set(all)
  if(arg_ALL)
    set(all ALL)
  endif()
  add_custom_target(${arg_TARGET} ${all} DEPENDS ${outputs})
  set_target_properties(${arg_TARGET} PROPERTIES LOZENGE_ASSETS "${outputs}")
endfunction()

cmake_policy(POP)
