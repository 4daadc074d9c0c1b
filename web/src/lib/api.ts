// The daemon's API, typed by its own contract. Everything that the dashboard asks or sends goes through this file.

import type { components, paths } from '../generated/api';
import { problemOf, unreachable } from './problem';

/** A schema of the contract: `Schema<'Alert'>`. */
export type Schema<Name extends keyof components['schemas']> = components['schemas'][Name];

type Method = 'get' | 'post' | 'put' | 'patch' | 'delete';
/** The addresses that take a method. */
export type PathOf<M extends Method> = {
  [P in keyof paths]: paths[P] extends { [K in M]: { responses: unknown } } ? P : never;
}[keyof paths];
type Operation<P extends keyof paths, M extends Method> = M extends keyof paths[P] ? paths[P][M] : never;

type PathParameters<O> = O extends { parameters: { path: infer Values } } ? Values : never;
type QueryParameters<O> = O extends { parameters: { query?: infer Values } } ? Exclude<Values, undefined> : never;
type BodyOf<O> = O extends { requestBody: { content: { 'application/json': infer Body } } } ? Body : never;
type Good = 200 | 201 | 202;
type JsonIn<R> = {
  [S in keyof R]: S extends Good ? (R[S] extends { content: { 'application/json': infer T } } ? T : never) : never;
}[keyof R];
/** What comes back when all is well. */
export type AnswerOf<P extends keyof paths, M extends Method> =
  Operation<P, M> extends { responses: infer R } ? JsonIn<R> : never;

/** The parameters of a call; those that the contract does not know are no property here. */
export type Parameters<P extends keyof paths, M extends Method> = ([PathParameters<Operation<P, M>>] extends [never]
  ? { path?: never }
  : { path: PathParameters<Operation<P, M>> }) & {
  query?: { [K in keyof QueryParameters<Operation<P, M>>]?: QueryParameters<Operation<P, M>>[K] | undefined };
};

/** A GET address with its parameters filled in, which remembers what is found there. Equal addresses are equal texts. */
export type Address<T> = string & { readonly answer?: T };

export function address<P extends PathOf<'get'>>(
  path: P,
  ...given: {} extends Parameters<P, 'get'> ? [Parameters<P, 'get'>?] : [Parameters<P, 'get'>]
): Address<AnswerOf<P, 'get'>> {
  return fill(path, given[0]);
}

function fill(path: string, parameters?: { path?: unknown; query?: unknown }): string {
  const places = (parameters?.path ?? {}) as Record<string, string | number>;
  const filled = path.replace(/\{(\w+)\}/g, (_, name: string) => encodeURIComponent(String(places[name])));
  const query = new URLSearchParams();
  for (const [name, value] of Object.entries((parameters?.query ?? {}) as Record<string, unknown>)) {
    if (value !== undefined && value !== null && value !== '') query.set(name, String(value));
  }
  query.sort();
  return query.size > 0 ? `${filled}?${query}` : filled;
}

/** What a request brought, with the version that an edit can name (`If-Match`). */
export interface Answer<T> {
  readonly data: T;
  readonly etag: string | undefined;
}

/** Asks for what is at an address: JSON, or text where there is no JSON (`/metrics`). @returns nothing when it is still what `etag` names. @throws Problem */
export async function ask<T>(
  from: Address<T>,
  options: { etag?: string | undefined; signal?: AbortSignal } = {},
): Promise<Answer<T> | undefined> {
  const headers: Record<string, string> = {};
  if (options.etag !== undefined) headers['If-None-Match'] = options.etag;
  const response = await request(from, { headers, ...(options.signal ? { signal: options.signal } : {}) });
  if (response.status === 304) return undefined;
  const isJson = response.headers.get('Content-Type')?.includes('json') ?? false;
  return {
    data: (isJson ? await response.json() : await response.text()) as T,
    etag: response.headers.get('ETag') ?? undefined,
  };
}

/** Asks for bytes, such as points. @throws Problem */
export async function fetchBytes(from: string, signal?: AbortSignal): Promise<ArrayBuffer> {
  return (await request(from, signal ? { signal } : {})).arrayBuffer();
}

type SendOptions<P extends keyof paths, M extends Method> = Parameters<P, M> &
  ([BodyOf<Operation<P, M>>] extends [never] ? { body?: never } : { body: BodyOf<Operation<P, M>> }) & {
    /** The version that is edited; a `precondition-failed` problem when there is another meanwhile. */
    etag?: string | undefined;
    signal?: AbortSignal;
  };

/** Makes, edits or deletes something. @throws Problem */
export async function send<M extends Exclude<Method, 'get'>, P extends PathOf<M>>(
  method: M,
  path: P,
  options: SendOptions<P, M>,
): Promise<Answer<AnswerOf<P, M>>> {
  const headers: Record<string, string> = { Accept: 'application/json' };
  if (options.body !== undefined) headers['Content-Type'] = 'application/json';
  if (options.etag !== undefined) headers['If-Match'] = options.etag;
  const response = await request(fill(path, options), {
    method: method.toUpperCase(),
    headers,
    ...(options.body !== undefined ? { body: JSON.stringify(options.body) } : {}),
    ...(options.signal ? { signal: options.signal } : {}),
  });
  const text = await response.text();
  return {
    data: (text === '' ? undefined : JSON.parse(text)) as AnswerOf<P, M>,
    etag: response.headers.get('ETag') ?? undefined,
  };
}

/** @throws Problem for every answer that is no success, and when there is none; AbortError as it is. */
async function request(url: string, init: RequestInit): Promise<Response> {
  let response: Response;
  try {
    // What may be kept is kept by lib/resources.ts, with the version of each; a second copy would be of no use.
    response = await fetch(url, { cache: 'no-store', ...init });
  } catch (failure) {
    if (failure instanceof DOMException && failure.name === 'AbortError') throw failure;
    throw unreachable();
  }
  if (response.ok || response.status === 304) return response;
  throw problemOf(response.status, await response.text());
}

/** What the daemon is told about a scan file beside its bytes. */
export type ScanHints = NonNullable<Parameters<'/api/v1/scans', 'post'>['query']>;

/** Uploads a scan file; `onProgress` hears how many bytes are sent. @throws Problem; AbortError when `signal` ends it. */
export function uploadScan(
  file: Blob,
  hints: ScanHints,
  onProgress: (sent_bytes: number) => void,
  signal?: AbortSignal,
): Promise<Schema<'UploadedScans'>> {
  return new Promise((resolve, reject) => {
    const upload = new XMLHttpRequest(); // fetch tells nothing of how much was sent
    upload.open('POST', fill('/api/v1/scans', { query: hints }));
    upload.setRequestHeader('Content-Type', 'application/octet-stream');
    upload.upload.onprogress = (event) => onProgress(event.loaded);
    upload.onerror = () => reject(unreachable());
    upload.onabort = () => reject(new DOMException('aborted', 'AbortError'));
    upload.onload = () => {
      if (upload.status < 300) resolve(JSON.parse(upload.responseText) as Schema<'UploadedScans'>);
      else reject(problemOf(upload.status, upload.responseText));
    };
    signal?.addEventListener('abort', () => upload.abort());
    upload.send(file);
  });
}
