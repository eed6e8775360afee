// Tells the linker of emscripten which functions the page brings (src/engine/wasm.ts); nothing of this file is part of it.
mergeInto(LibraryManager.library, { sf_watch: function () {} });
