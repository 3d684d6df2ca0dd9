# Installs the programs to PREFIX and runs them in a folder of its own. Materials are taken from PREFIX, not from the source tree:
# one is renamed there, so that only the installed folder has it.
function(run expected)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${WORK} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0 OR NOT output MATCHES "${expected}")
    message(FATAL_ERROR "${ARGN}\nended with ${result}; \"${expected}\" is required in\n${output}")
  endif()
endfunction()
file(REMOVE_RECURSE ${WORK} ${PREFIX})
file(MAKE_DIRECTORY ${WORK})
run("" ${CMAKE_COMMAND} --install ${BUILD} --component runtime --prefix ${PREFIX})
file(RENAME ${PREFIX}/${DATA}/brisance/materials/steel_4340.toml ${PREFIX}/${DATA}/brisance/materials/only_installed.toml)
run("only_installed.toml" ${PREFIX}/${BIN}/pointdriver check)
run("1 files: [0-9]+ ok" ${PREFIX}/${BIN}/pointdriver check only_installed.toml)
run("only_installed.toml" ${PREFIX}/${BIN}/brisance list)
run("${DATA}/brisance/cases/sod.toml" ${PREFIX}/${BIN}/brisance list cases)
file(WRITE ${WORK}/case.toml "geometry = \"plane\"\ncell_size = 0.1\nend_time = 1e-6\n[[solid]]\nname = \"block\"\n\
material = \"only_installed.toml\"\ntemperature = 298\nshape = { box = { lower = [0, 0], upper = [1, 1] } }\n")
run("particles" ${PREFIX}/${BIN}/brisance check case.toml)
