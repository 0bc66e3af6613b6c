# Three ways to build in less time. Off unless asked for (`make test`, `make demo` and `make lint` ask),
# so that a build with catkin shows that each file includes what it uses.
option(FRONTSEAT_QUICK_BUILD "Compile small files together and common headers once" OFF)

# compile_together(<target>...): eight files of a target at a time.
function(compile_together)
  if(FRONTSEAT_QUICK_BUILD)
    set_target_properties(${ARGN} PROPERTIES UNITY_BUILD ON)
  endif()
endfunction()

# compile_without_optimizing(<target>...): generated code, which takes the compiler longest.
function(compile_without_optimizing)
  foreach(target ${ARGN})
    target_compile_options(${target} PRIVATE $<$<BOOL:${FRONTSEAT_QUICK_BUILD}>:-O0>)
  endforeach()
endfunction()

# share_precompiled_headers(<header>... USED_BY <owner> <target>...): only targets with the same
# compiler flags can share, and what the owner defines must be defined for the others too.
function(share_precompiled_headers)
  cmake_parse_arguments(shared "" "" "USED_BY" ${ARGN})
  list(GET shared_USED_BY 0 owner)
  if(NOT FRONTSEAT_QUICK_BUILD OR NOT TARGET ${owner})
    return()
  endif()
  target_precompile_headers(${owner} PRIVATE ${shared_UNPARSED_ARGUMENTS})
  list(REMOVE_AT shared_USED_BY 0)
  foreach(target ${shared_USED_BY})
    target_precompile_headers(${target} REUSE_FROM ${owner})
  endforeach()
endfunction()
