/**
 * The app without a network. offline.mjs writes `version` and `files` above this, the paths of all files of one version
 * with their digests, so that a host in the middle of an update gives no mixture of two.
 *
 * Each version stands in a cache of its own. The newest takes over at once and gives its own pages to whoever opens or
 * reloads one. An open page goes on with its own scripts and engine, whose names no other version has: their cache stays
 * until no page needs it. Nothing is ever given in place of something else.
 */
const { scope } = self.registration;
const prefix = `voxtet ${scope} `;
const ownCache = prefix + version;

/** With these a page may share memory, and so have threads. Some hosts cannot be told to send them. */
const isolation = {
  'Cross-Origin-Opener-Policy': 'same-origin',
  'Cross-Origin-Embedder-Policy': 'require-corp',
};

/** A path within the app, '' where the address lies outside of it. */
function pathOf(address) {
  const { origin, pathname } = new URL(address, scope);
  const at = origin + pathname;
  return at.startsWith(scope) ? at.slice(scope.length) || 'index.html' : '';
}

function isolated(response) {
  if (!response.ok) return response;
  const headers = new Headers(response.headers);
  for (const [name, value] of Object.entries(isolation)) if (!headers.has(name)) headers.set(name, value);
  return new Response(response.body, { headers });
}

/** What lies in assets/ never changes under its name: it need not be asked for again. */
const isNamedByDigest = (path) => path.startsWith('assets/');

/** Whether a response is what the list says: some hosts answer with a page of theirs where a file is missing. */
async function holds(response, integrity) {
  const digest = new Uint8Array(await crypto.subtle.digest('SHA-256', await response.arrayBuffer()));
  return integrity === `sha256-${btoa(String.fromCharCode(...digest))}`;
}

async function keepAll() {
  const cache = await caches.open(ownCache);
  const keep = async ([path, integrity]) => {
    const address = new URL(path, scope).href;
    const known = isNamedByDigest(path) && (await caches.match(address));
    if (known && (await holds(known.clone(), integrity))) return cache.put(address, known);
    const response = await fetch(address, {
      integrity,
      cache: isNamedByDigest(path) ? 'default' : 'no-cache',
    });
    if (!response.ok) throw new Error(`${address} answered ${response.status}.`);
    return cache.put(address, isolated(response));
  };
  await Promise.all(Object.entries(files).map(keep));
}

/** Removes versions that no page needs any more. A page holds a lock with the name of its script for as long as it lives. */
async function forgetOld() {
  const others = (await caches.keys()).filter((name) => name.startsWith(prefix) && name !== ownCache);
  // One of them may be about to follow this one.
  if (self.registration.installing || self.registration.waiting) return;
  const { held } = await navigator.locks.query();
  const strange = held.map(({ name }) => name).filter((name) => !(pathOf(name) in files));
  for (const name of others) {
    const cache = await caches.open(name);
    const needed = await Promise.all(strange.map((script) => cache.match(script)));
    if (!needed.some(Boolean)) await caches.delete(name);
  }
}

async function answer(path, request) {
  const address = new URL(path, scope).href;
  const cache = await caches.open(ownCache);
  const known = (await cache.match(address)) ?? (await caches.match(address));
  if (known) return known;
  const response = isolated(await fetch(request));
  // What few need is kept from its first use on.
  if (response.ok && isNamedByDigest(path)) await cache.put(address, response.clone());
  return response;
}

self.addEventListener('install', (event) => {
  self.skipWaiting();
  event.waitUntil(keepAll());
});

self.addEventListener('activate', (event) => event.waitUntil(self.clients.claim().then(forgetOld)));

self.addEventListener('fetch', (event) => {
  // Whether the app may be a part of another page is for the host's own headers to say.
  if (new URL(event.request.url).searchParams.has('embed')) return;
  const path = pathOf(event.request.url);
  if (event.request.method !== 'GET' || !(path in files || isNamedByDigest(path))) return;
  event.respondWith(answer(path, event.request));
});

/** A page says which script it runs, and hears where that is of another version. */
self.addEventListener('message', (event) => {
  if (!(pathOf(event.data) in files)) event.source.postMessage('other version');
  event.waitUntil(forgetOld());
});
