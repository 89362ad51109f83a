# SPDX-License-Identifier: Apache-2.0
# GLSL to SPIR-V at build time, with dependency tracking, embedded in the library.
find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)

# gnomon_shader(OUT_VAR NAME SOURCE [include folder...] [DEFINES name...] [DEPENDS file...]): compiles SOURCE (like the folders relative to
# comp_shaders, or absolute) into a header that defines the array NAME, and appends the header to OUT_VAR. DEPENDS: included files that are made.
function(gnomon_shader out_var name source)
  cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${PROJECT_SOURCE_DIR}/comp_shaders OUTPUT_VARIABLE input)
  set(header ${PROJECT_BINARY_DIR}/shaders/${name}.spv.h)
  cmake_parse_arguments(PARSE_ARGV 3 arg "" "" "DEFINES;DEPENDS")
  set(options "")
  foreach(folder ${arg_UNPARSED_ARGUMENTS})
    cmake_path(ABSOLUTE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR}/comp_shaders)
    list(APPEND options -I${folder})
  endforeach()
  foreach(define ${arg_DEFINES})
    list(APPEND options -D${define})
  endforeach()
  add_custom_command(
    OUTPUT ${header}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${PROJECT_BINARY_DIR}/shaders
    COMMAND ${GLSLANG_VALIDATOR} --quiet --target-env vulkan1.3 -I${PROJECT_SOURCE_DIR}/comp_shaders ${options}
            --depfile ${header}.d --vn ${name} -o ${header} ${input}
    DEPENDS ${input} ${arg_DEPENDS}
    DEPFILE ${header}.d
    COMMENT "Shader ${source}"
    VERBATIM)
  set(${out_var} ${${out_var}} ${header} PARENT_SCOPE)
endfunction()
