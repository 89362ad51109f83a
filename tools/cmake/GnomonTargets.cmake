# SPDX-License-Identifier: Apache-2.0
# What every target of ours is compiled with.
option(GNOMON_ASSERTS "Keep asserts in optimised builds" OFF)
option(GNOMON_SANITIZE "Address and undefined-behaviour sanitizers" OFF)
option(GNOMON_FUZZ "libFuzzer's instrumentation, and its targets in tests/fuzz; for Clang" OFF)

function(gnomon_configure target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  # -ffp-contract=off: the headers shared with the shaders must give the shaders' bits.
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -ffp-contract=off)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # GCC bug 105651: at -O3 a string literal + std::string is said to overlap itself.
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-Wno-restrict>)
  endif()
  target_compile_definitions(${target} PUBLIC GLM_FORCE_XYZW_ONLY)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/comp_shaders)
  if(GNOMON_ASSERTS)
    target_compile_options(${target} PRIVATE -UNDEBUG)
  endif()
  if(GNOMON_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=address,undefined -fno-sanitize-recover=undefined)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized)  # False ones in <regex> when sanitizers are on.
    endif()
    target_link_options(${target} PUBLIC -fsanitize=address,undefined)
  endif()
  if(GNOMON_FUZZ)
    # glslang has no type information, which the check of vptr needs.
    target_compile_options(${target} PRIVATE -fsanitize=fuzzer-no-link -fno-sanitize=vptr)
  endif()
endfunction()

# A part of the library: gnomon_part(NAME source...) makes the static library gnomon_NAME.
function(gnomon_part name)
  add_library(gnomon_${name} STATIC ${ARGN})
  gnomon_configure(gnomon_${name})
  set_target_properties(gnomon_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON EXPORT_NAME ${name})
  target_include_directories(gnomon_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
    $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(gnomon_${name} PUBLIC glm::glm)
endfunction()

# gnomon_embed_files(FOLDER HEADER TABLE name...): the files of the folder as text by name, in an array of a header that is made.
function(gnomon_embed_files folder header table)
  set(script ${PROJECT_SOURCE_DIR}/tools/cmake/EmbedSources.cmake)
  list(TRANSFORM ARGN PREPEND ${folder}/ OUTPUT_VARIABLE files)
  add_custom_command(
    OUTPUT ${header}
    COMMAND ${CMAKE_COMMAND} -DFOLDER=${folder} -DOUTPUT=${header} -DTABLE=${table} "-DNAMES=${ARGN}" -P ${script}
    DEPENDS ${files} ${script}
    COMMENT "Files of ${folder}"
    VERBATIM)
endfunction()
