// Emscripten programs see an empty environment; tests need the host's (VOXTET_DATA and the like).
#include <emscripten.h>

#include <cstdlib>

extern "C" EMSCRIPTEN_KEEPALIVE void voxtet_setenv(const char* name, const char* value) {
  setenv(name, value, 1);
}

namespace {
struct ImportEnvironment {
  ImportEnvironment() {
    EM_ASM({
      for (const name in process.env) {
        if (name.startsWith('VOXTET_'))
          ccall('voxtet_setenv', null, [ 'string', 'string' ], [ name, process.env[name] ]);
      }
    });
  }
} import_environment;
}  // namespace
