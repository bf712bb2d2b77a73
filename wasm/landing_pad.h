// Included ahead of every C++ file of WebAssembly with threads. Where an exception lands, the compiler's code
// and the personality routine talk through the variable __wasm_lpad_context. The routine of Emscripten 3.1.6
// has one for each thread, the code of clang 14 one for all, so that no catch is ever taken. Clang uses the
// declaration that it finds: this one, which is the routine's own.
#pragma once

extern "C" {
struct VoxtetLandingPad {
  unsigned long index;
  const char* data;
  unsigned long selector;
};
extern __thread VoxtetLandingPad __wasm_lpad_context;
/// A use, without which the declaration would be dropped.
__attribute__((used)) static inline void* voxtet_landing_pad() {
  return &__wasm_lpad_context;
}
}
