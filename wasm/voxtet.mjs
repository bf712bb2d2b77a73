#!/usr/bin/env node
// The command line of voxtet as WebAssembly. Emscripten's loader is CommonJS and would fetch its own file.
import { createRequire } from 'node:module';

delete globalThis.fetch;
createRequire(import.meta.url)('./voxtet_cli.js');
