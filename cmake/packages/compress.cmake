# Run by cpack on what it is going to pack: manual pages and changelogs are compressed, as Debian's policy wants them.
cmake_minimum_required(VERSION 3.22)

file(GLOB_RECURSE changes ${CPACK_TEMPORARY_DIRECTORY}/CHANGELOG.md)
foreach(file ${changes})
  get_filename_component(folder ${file} DIRECTORY)
  file(RENAME ${file} ${folder}/changelog)
endforeach()

file(GLOB_RECURSE texts ${CPACK_TEMPORARY_DIRECTORY}/*.1 ${CPACK_TEMPORARY_DIRECTORY}/changelog
                        ${CPACK_TEMPORARY_DIRECTORY}/changelog.Debian)
foreach(text ${texts})
  execute_process(COMMAND gzip --best --no-name ${text} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
