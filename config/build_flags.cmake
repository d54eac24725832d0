# ridgeline_flags: what every room is built with. ridgeline_core_flags: core/ besides (no exceptions, no RTTI).
add_library(ridgeline_flags INTERFACE)
target_compile_features(ridgeline_flags INTERFACE cxx_std_20)
# -ffp-contract=off: a fused multiply-add would make the same source give different bits on another machine.
target_compile_options(ridgeline_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wdouble-promotion
  -Wnon-virtual-dtor -Wold-style-cast -ffp-contract=off
  $<$<BOOL:${RL_WERROR}>:-Werror>)
# With -O3 g++ 12 takes `"text" + std::string` for a copy onto itself (its fault 105329).
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(ridgeline_flags INTERFACE $<$<CONFIG:Release>:-Wno-restrict>)
endif()
if(RL_SANITIZE)
  target_compile_options(ridgeline_flags INTERFACE -fsanitize=${RL_SANITIZE} -fno-omit-frame-pointer)
  if(RL_FUZZ)
    # What a sanitizer finds is a failed run, not a line in its output.
    target_compile_options(ridgeline_flags INTERFACE -fno-sanitize-recover=all)
  endif()
  target_link_options(ridgeline_flags INTERFACE -fsanitize=${RL_SANITIZE})
endif()
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

add_library(ridgeline_core_flags INTERFACE)
target_link_libraries(ridgeline_core_flags INTERFACE ridgeline_flags)
target_compile_options(ridgeline_core_flags INTERFACE -fno-exceptions -fno-rtti)

# ridgeline_room(NAME SOURCES ... USES ...): one static library with the alias ridgeline::NAME.
function(ridgeline_room name)
  cmake_parse_arguments(ARG "" "" "SOURCES;USES;PRIVATE;FLAGS" ${ARGN})
  add_library(ridgeline_${name} STATIC ${ARG_SOURCES})
  add_library(ridgeline::${name} ALIAS ridgeline_${name})
  target_include_directories(ridgeline_${name} PUBLIC ${PROJECT_SOURCE_DIR})
  if(ARG_FLAGS)
    target_link_libraries(ridgeline_${name} PRIVATE ${ARG_FLAGS})
  else()
    target_link_libraries(ridgeline_${name} PRIVATE ridgeline_flags)
  endif()
  target_link_libraries(ridgeline_${name} PUBLIC ${ARG_USES} PRIVATE ${ARG_PRIVATE})
endfunction()
