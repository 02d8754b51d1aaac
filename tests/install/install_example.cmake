# Installs a build tree into a prefix of its own, builds the example against it, runs it and looks at what it prints.
# cmake -D BUILD=<build tree> -D SOURCE=<source tree> -D WORK=<scratch folder> -D CONFIG= -D COMPILER= -D FLAGS=
#       -D GENERATOR= -P install_example.cmake
file(REMOVE_RECURSE ${WORK})
set(prefix ${WORK}/prefix)

function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    string(JOIN " " command ${ARGV})
    message(FATAL_ERROR "${command}\nended with ${status}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

# The page on the library shows this example, as it is.
file(READ ${SOURCE}/docs/library.md page)
foreach(shown example.cpp CMakeLists.txt)
  file(READ ${CMAKE_CURRENT_LIST_DIR}/${shown} text)
  string(REGEX REPLACE "^#[^\n]*\n" "" text "${text}")
  string(FIND "${page}" "${text}" place)
  if(place EQUAL -1)
    message(FATAL_ERROR "docs/library.md does not show tests/install/${shown} as it is")
  endif()
endforeach()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
file(GLOB_RECURSE config ${prefix}/*/mortiseConfig.cmake)
file(GLOB_RECURSE module ${prefix}/mortise_gmsh.so)
file(GLOB_RECURSE license ${prefix}/LICENSE)
foreach(file "${config}" "${module}" "${license}" ${prefix}/bin/mortise ${prefix}/include/mortise/mortise/solve.hpp)
  if(NOT EXISTS "${file}")
    message(FATAL_ERROR "not installed: '${file}' (configuration, gmsh's module, licence, executable or headers)")
  endif()
endforeach()
run(${prefix}/bin/mortise --version)

# The prefix moves before it is used: nothing in it may remember where it was, or where mortise was built.
file(RENAME ${prefix} ${WORK}/moved)
file(GLOB_RECURSE package ${WORK}/moved/*/mortise*.cmake)
foreach(file ${package})
  file(READ ${file} text)
  foreach(place ${SOURCE} ${BUILD} ${prefix} "/lib[a-z_]*(gmsh|cholmod|amd|metis|openblas)[.]so")
    if(text MATCHES "${place}")
      message(FATAL_ERROR "${file} names ${CMAKE_MATCH_0}, a place of the machine that built it")
    endif()
  endforeach()
endforeach()

# The moved program finds gmsh's module, and says what is missing without it.
run(${WORK}/moved/bin/mortise mesh ${SOURCE}/geo/patch_flat.toml -o ${WORK}/a.msh)
file(GLOB_RECURSE module ${WORK}/moved/mortise_gmsh.so)
file(RENAME ${module} ${module}.away)
execute_process(COMMAND ${WORK}/moved/bin/mortise mesh ${SOURCE}/geo/patch_flat.toml -o ${WORK}/b.msh
                RESULT_VARIABLE status ERROR_VARIABLE output)
file(RENAME ${module}.away ${module})
if(NOT status EQUAL 1 OR NOT output MATCHES "which cannot be loaded: mortise_gmsh[.]so: ")
  message(FATAL_ERROR "without gmsh's module: ended with ${status}:\n${output}")
endif()

run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${WORK}/example -G ${GENERATOR}
    -D CMAKE_PREFIX_PATH=${WORK}/moved -D CMAKE_BUILD_TYPE=${CONFIG} -D CMAKE_CXX_COMPILER=${COMPILER}
    "-DCMAKE_CXX_FLAGS=${FLAGS}")
run(${CMAKE_COMMAND} --build ${WORK}/example)
run(${WORK}/example/example ${SOURCE}/geo/parabola_1.toml)

# 10 MPa on the top of two plates held sideways: the mean contact pressure is near that on any mesh.
if(NOT output MATCHES "mean ([0-9.e+]+)")
  message(FATAL_ERROR "no mean pressure in the example's output:\n${output}")
endif()
if(CMAKE_MATCH_1 LESS 0.9e7 OR CMAKE_MATCH_1 GREATER 1.1e7)
  message(FATAL_ERROR "mean pressure ${CMAKE_MATCH_1}; expected 1e7 within 10 %:\n${output}")
endif()
message(STATUS "mean pressure ${CMAKE_MATCH_1}")
