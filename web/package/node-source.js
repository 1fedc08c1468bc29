import { readFile } from 'node:fs/promises';

/** Returns the bytes of a file, or the answer of a server. place: a URL, its text, or a path. */
export async function sourceAt(place) {
  // A single letter before the colon is a drive of Windows.
  const url = typeof place === 'string' && /^[a-z][a-z\d+.-]+:/i.test(place) ? new URL(place) : place;
  return /^https?:$/.test(url?.protocol) ? fetch(url) : readFile(url);
}
