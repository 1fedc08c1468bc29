// Runs a command of WASI that only prints, in Node or in a browser. Returns its exit code and what it printed.
export async function runCommand(module) {
  let memory, text = '';
  const decoder = new TextDecoder();
  class Exit { constructor(code) { this.code = code; } }
  const calls = {
    args_sizes_get: (count, bytes) => { new Uint32Array(memory.buffer)[count >> 2] = 0; new Uint32Array(memory.buffer)[bytes >> 2] = 0; return 0; },
    environ_sizes_get: (count, bytes) => calls.args_sizes_get(count, bytes),
    fd_fdstat_get: () => 0,
    fd_write: (file, list, count, written) => {
      const words = new Uint32Array(memory.buffer);
      let all = 0;
      for (let k = 0; k < count; k++) {
        const [at, size] = words.subarray((list >> 2) + 2 * k);
        text += decoder.decode(new Uint8Array(memory.buffer, at, size), { stream: true });
        all += size;
      }
      words[written >> 2] = all;
      return 0;
    },
    proc_exit: (code) => { throw new Exit(code); },
  };
  const others = new Proxy(calls, { get: (known, name) => known[name] ?? (() => 0) });
  const { exports } = await WebAssembly.instantiate(module, { wasi_snapshot_preview1: others });
  memory = exports.memory;
  try {
    exports._start();
    return { code: 0, text };
  } catch (end) {
    if (end instanceof Exit) return { code: end.code, text };
    throw end;
  }
}
