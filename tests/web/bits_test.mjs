// bits_test.mjs WEB_BITS_WASM NATIVE_PROGRAM: the hashes of tests/properties/bits by the module in Node, against
// those of the class without fused operations by the native build.
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { runCommand } from './wasi_command.mjs';

const [wasm, native] = process.argv.slice(2);
const { code, text } = await runCommand(await WebAssembly.compile(readFileSync(wasm)));
const lines = (output) => output.split('\n').filter((line) => line.startsWith('nofma '));
const here = lines(text);
const there = lines(execFileSync(native, { encoding: 'utf8' }));
if (code !== 0 || here.length === 0) throw new Error(`expected hashes, found exit code ${code} and ${here.length} lines`);
const others = here.filter((line) => !there.includes(line));
if (others.length > 0 || here.length !== there.length) {
  throw new Error(`bits differ.\nWebAssembly:\n${here.join('\n')}\nnative:\n${there.join('\n')}`);
}
console.log(`${here.length} hashes are those of the native build`);
