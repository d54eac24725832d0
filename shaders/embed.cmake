# Joins version line, shared block file, libraries and one pass into a C++ string.
# and has glslang check it: an error is a build error.
# cmake -DOUTPUT=... -DNAME=... -DSTAGE=comp -DVALIDATOR=... -DPARTS="a;b;c" [-DSENT="a;b"] -P embed.cmake

# Members of uniform blocks that the vertex stage sends on to the fragment stage: both know them by
# their own name, and the vertex stage has a function that sends them.
function(send_members body_variable)
  set(body "${${body_variable}}")
  set(way in)
  if(STAGE STREQUAL "vert")
    set(way out)
  endif()
  set(declared "")
  set(assigned "")
  foreach(name IN LISTS SENT)
    if(NOT body MATCHES "  (i?vec4) ${name}(\\[[0-9]\\])?;")
      message(FATAL_ERROR "${NAME}: no block has a member ${name}")
    endif()
    string(APPEND declared "flat ${way} ${CMAKE_MATCH_1} ${name}${CMAKE_MATCH_2};\n")
    string(APPEND assigned "  ${name} = uniform_${name};\n")
    string(REPLACE "${CMAKE_MATCH_0}" "  ${CMAKE_MATCH_1} uniform_${name}${CMAKE_MATCH_2};" body "${body}")
  endforeach()
  string(APPEND body "${declared}")
  if(STAGE STREQUAL "vert")
    string(APPEND body "void send_members() {\n${assigned}}\n")
  endif()
  set(${body_variable} "${body}" PARENT_SCOPE)
endfunction()

set(text "#version 310 es\n#ifndef level_count\n#define level_count window.z\n#endif\nprecision highp float;\nprecision highp int;\n")
set(number 0)
foreach(part IN LISTS PARTS)
  file(READ "${part}" body)
  get_filename_component(file_name "${part}" NAME)
  if(file_name STREQUAL "frame_block.h")
    # Constants become macros: ES GLSL takes only literal bindings.
    string(REGEX REPLACE "RL_CONST\\(([a-z_]+), ([0-9]+)\\);" "#define \\1 \\2" body "${body}")
    if(NOT STAGE STREQUAL "comp")
      send_members(body)
    endif()
  endif()
  string(APPEND text "#line 1 ${number}\n${body}\n")
  math(EXPR number "${number} + 1")
endforeach()
file(WRITE "${OUTPUT}.glsl" "${text}")
file(WRITE "${OUTPUT}"
  "#pragma once\n#include <string_view>\nnamespace ridgeline::shader {\n"
  "inline constexpr std::string_view ${NAME} = R\"GLSL(${text})GLSL\";\n}\n")
execute_process(COMMAND "${VALIDATOR}" -S "${STAGE}" "${OUTPUT}.glsl"
  RESULT_VARIABLE failed OUTPUT_VARIABLE log ERROR_VARIABLE log)
if(failed)
  file(REMOVE "${OUTPUT}")
  message(FATAL_ERROR "${NAME}: files are numbered in order: ${PARTS}\n${log}")
endif()
