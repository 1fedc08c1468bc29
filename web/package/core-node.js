import { instantiate } from './library.js';
import { sourceAt } from './node-source.js';
export { instantiate };
export const load = async (url = new URL('./simdbezier-core.wasm', import.meta.url)) => instantiate(await sourceAt(url));
