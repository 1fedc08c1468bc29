import { instantiate } from './library.js';
export { instantiate };
export const load = async (url = new URL('./simdbezier-f64.wasm', import.meta.url)) => instantiate(fetch(url));
