// From the page's JSON to numbers: packed tables, columns, and pixels as schema.ts defines them.
import type { Cell, Columns, Packed, Pixels } from "./schema";

/** The numbers of an image, row by row from the top. Throws where the data are not as many as w and h say. */
export async function decodePixels(p: Pixels): Promise<Float32Array> {
  const stored = bytesOf(p.data);
  const bytes = p.gzip ? await gunzip(stored) : stored;
  const count = p.w * p.h;
  const size = p.type === "f16" ? 2 : 4;
  if (bytes.length !== count * size) {
    throw new Error(`${p.w} x ${p.h} pixels of ${p.type} are ${count * size} bytes, but ${bytes.length} are stored`);
  }
  // The i-th value's byte k: planes lie behind each other, else values do. Nothing here depends on the machine's order.
  const step = p.shuffle ? 1 : size;
  const plane = p.shuffle ? count : 1;
  const out = new Float32Array(count);
  if (p.type === "f16") {
    const table = halfTable();
    for (let i = 0, at = 0; i < count; ++i, at += step) out[i] = table[bytes[at]! | (bytes[at + plane]! << 8)]!;
  } else {
    const bits = new Uint32Array(out.buffer);
    for (let i = 0, at = 0; i < count; ++i, at += step) {
      bits[i] =
        bytes[at]! | (bytes[at + plane]! << 8) | (bytes[at + 2 * plane]! << 16) | (bytes[at + 3 * plane]! << 24);
    }
  }
  if (p.scale !== 1) for (let i = 0; i < count; ++i) out[i] = out[i]! * p.scale;
  return out;
}

const unpacked = new WeakMap<Packed, Promise<unknown>>();

/** The value itself, unpacked where it is packed; each is unpacked once. */
export async function unpack<T>(x: T | Packed): Promise<T> {
  if (!isPacked(x)) return x;
  let value = unpacked.get(x) as Promise<T> | undefined;
  if (value === undefined) {
    value = gunzip(bytesOf(x.gz)).then((bytes) => JSON.parse(new TextDecoder().decode(bytes)) as T);
    unpacked.set(x, value);
  }
  return value;
}

/** The cells of one column, as many as the table has rows; none where it lacks the column. */
export function column(table: Columns, name: string): Cell[] {
  const cells = table.columns[name];
  if (cells === undefined) return [];
  return Array.isArray(cells) ? cells : new Array<Cell>(table.length).fill(cells.all);
}

function isPacked(x: unknown): x is Packed {
  return typeof x === "object" && x !== null && typeof (x as { gz?: unknown }).gz === "string";
}

function bytesOf(base64: string): Uint8Array<ArrayBuffer> {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

async function gunzip(bytes: Uint8Array<ArrayBuffer>): Promise<Uint8Array> {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

let halves: Float32Array | undefined;

/** All 65,536 half-precision numbers, IEEE 754-2019 binary16, by their bits. */
function halfTable(): Float32Array {
  if (halves !== undefined) return halves;
  halves = new Float32Array(1 << 16);
  for (let bits = 0; bits < 1 << 16; ++bits) {
    const sign = bits & 0x8000 ? -1 : 1;
    const exponent = (bits >> 10) & 31;
    const fraction = bits & 1023;
    let value = (1 + fraction / 1024) * 2 ** (exponent - 15);
    if (exponent === 0) value = (fraction / 1024) * 2 ** -14;
    if (exponent === 31) value = fraction === 0 ? Infinity : NaN;
    halves[bits] = sign * value;
  }
  return halves;
}
