# The flags that make native and wasm agree to the last bit: no contraction to FMA, the same CGAL arithmetic
# (no GMP, round-to-nearest intervals, since WebAssembly has no other), no reordering by Eigen.
add_compile_options(-ffp-contract=off)
add_compile_definitions(
  CGAL_DISABLE_GMP CGAL_ALWAYS_ROUND_TO_NEAREST EIGEN_DONT_VECTORIZE CGAL_NO_DEPRECATION_WARNINGS)
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
# What is built names no folder of the machine: the same bytes from every checkout, with or without ccache.
add_compile_options("-fmacro-prefix-map=${CMAKE_SOURCE_DIR}/=")

if(VOXTET_SANITIZE)
  # Without what the address sanitizer finds too (null pointers that are followed, accesses and pointers beyond an
  # object), alignment (no cast of a pointer asks for more of it) and vptr (there is hardly a virtual function): tests run
  # three to four times as fast.
  add_compile_options(-fsanitize=address,undefined
    -fno-sanitize=null,vptr,alignment,object-size,pointer-overflow -fno-sanitize-recover=undefined
    -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()

if(EMSCRIPTEN)
  # SIMD is what the compiler makes of loops: a quarter off smoothing and sizing, 7 % off the whole, the same bytes.
  add_compile_options(-fwasm-exceptions -msimd128)
  add_link_options(-fwasm-exceptions -sALLOW_MEMORY_GROWTH=1 -sMAXIMUM_MEMORY=4GB -sINITIAL_MEMORY=64MB
    # A loop that has its own function keeps it, even if called from one place only: see in_stretches.
    -sBINARYEN_EXTRA_PASSES=--one-caller-inline-max-function-size=60)
  set(VOXTET_MOST_THREADS 1)
  if(VOXTET_THREADS)
    set(VOXTET_MOST_THREADS 8)
    add_compile_options(-pthread "$<$<COMPILE_LANGUAGE:CXX>:SHELL:-include ${CMAKE_SOURCE_DIR}/wasm/landing_pad.h>")
    # A thread that waits for others cannot make more of them: as many as the machine runs are made at the start (under
    # node; the browser's module has its own number), and asking for more fails (STRICT=2) instead of waiting for ever.
    add_link_options(-pthread -Wno-pthreads-mem-growth -sPTHREAD_POOL_SIZE_STRICT=2
      "-sPTHREAD_POOL_SIZE=Math.min(require('os').cpus().length,${VOXTET_MOST_THREADS})-1")
  endif()
  add_compile_definitions(VOXTET_MOST_THREADS=${VOXTET_MOST_THREADS})
endif()

add_library(voxtet_warnings INTERFACE)
target_compile_options(voxtet_warnings INTERFACE -Wall -Wextra -Wpedantic)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # False alarms of GCC 12 on text + std::string (GCC bug 105651).
  target_compile_options(voxtet_warnings INTERFACE -Wno-restrict)
endif()
