import { readFile } from 'node:fs/promises';
import { instantiate } from './library.js';
export { instantiate };
export const load = async (url = new URL('./simdbezier-core.wasm', import.meta.url)) => instantiate(await readFile(url));
