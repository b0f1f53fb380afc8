# Run by the install target: installs the headers that are meant to be used, and those that they include. Before it,
# lozenge_source is set to the source folder and lozenge_include to where the headers go.

cmake_minimum_required(VERSION 3.22)

# with_includes(RESULT HEADERS...): the headers, and what they include of ours, found by following their includes.
function(with_includes result)
  set(found)
  set(todo ${ARGN})
  while(todo)
    list(POP_FRONT todo header)
    if(header IN_LIST found)
      continue()
    endif()
    list(APPEND found ${header})
    file(STRINGS ${lozenge_source}/${header} includes REGEX "^#include \"")
    foreach(include ${includes})
      string(REGEX REPLACE "^#include \"([^\"]+)\".*" "\\1" include "${include}")
      list(APPEND todo ${include})
    endforeach()
  endwhile()
  set(${result} ${found} PARENT_SCOPE)
endfunction()

# The nouns and their files; of each stage its verb, and the two that come in halves; the order.
file(GLOB headers RELATIVE ${lozenge_source}
     ${lozenge_source}/formats/base/*.h ${lozenge_source}/formats/surface/*.h ${lozenge_source}/formats/domain/*.h
     ${lozenge_source}/formats/patches/*.h ${lozenge_source}/formats/files/*_file.h)
list(FILTER headers EXCLUDE REGEX "fixtures\\.h$")
list(APPEND headers formats/files/file_kind.h stages/import/import_surface.h stages/sample/remesh.h
                    pipeline/build.h pipeline/quality/quality_report.h)
file(GLOB stages RELATIVE ${lozenge_source}/stages ${lozenge_source}/stages/*)
foreach(stage ${stages})
  if(EXISTS ${lozenge_source}/stages/${stage}/${stage}.h)
    list(APPEND headers stages/${stage}/${stage}.h)
  endif()
endforeach()

with_includes(headers ${headers})
foreach(header ${headers})
  get_filename_component(folder ${header} DIRECTORY)
  file(INSTALL ${lozenge_source}/${header} DESTINATION ${lozenge_include}/${folder})
endforeach()
