# ridgeline_shader(NAME STAGE PARTS...): the parts as one constexpr string in shaders/NAME.hpp of the
# generated folder, checked by glslang. A part is a file of the calling folder or, with its path from
# the root of the tree, of another. The outputs are collected in shader_outputs.
# ridgeline_tile_pass(NAME VERTEX SENT MEMBERS... PARTS PARTS...): a pass over tiles as NAME_vert and
# NAME_frag. SENT: what the vertex stage sends on of the uniform blocks (ADR 0022). Every OpenGL ES
# 3.1 takes 15 inputs of four numbers; an array counts each of its own, and the tile takes one.
find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)
set(generated_dir ${CMAKE_CURRENT_BINARY_DIR}/generated)
set(shader_outputs)

function(ridgeline_shader name stage)
  set(parts)
  foreach(part IN LISTS ARGN)
    if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${part})
      list(APPEND parts ${CMAKE_CURRENT_SOURCE_DIR}/${part})
    else()
      list(APPEND parts ${PROJECT_SOURCE_DIR}/${part})
    endif()
  endforeach()
  set(output ${generated_dir}/shaders/${name}.hpp)
  set(embed ${PROJECT_SOURCE_DIR}/shaders/embed.cmake)
  string(JOIN "$<SEMICOLON>" joined ${parts})
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DNAME=${name} -DSTAGE=${stage}
            -DVALIDATOR=${GLSLANG_VALIDATOR} "-DPARTS=${joined}" "-DSENT=${sent}" -P ${embed}
    DEPENDS ${parts} ${embed} VERBATIM)
  set(shader_outputs ${shader_outputs} ${output} PARENT_SCOPE)
endfunction()

macro(ridgeline_tile_pass name vertex)
  cmake_parse_arguments(pass "" "" "SENT;PARTS" ${ARGN})
  string(JOIN "$<SEMICOLON>" sent ${pass_SENT})
  ridgeline_shader(${name}_vert vert frame_block.h tile.glsl tile_list.glsl tile_square.glsl ${vertex})
  ridgeline_shader(${name}_frag frag frame_block.h tile.glsl tile_frag.glsl ${pass_PARTS})
  set(sent)
endmacro()
