// Reads the EXR files that the program writes: one channel of 32-bit floats, scan lines, ZIP compression or none.
// Layout: "OpenEXR File Layout", openexr.com; the byte order and the predictor of ZIP from "Technical Introduction".
import { readFileSync } from "node:fs";
import { inflateSync } from "node:zlib";

const kRowsOfBlock = { 0: 1, 2: 1, 3: 16 }; // by compression: none, ZIPS, ZIP

/** { w, h, y: Float32Array }, row by row from the top. Throws on any other kind of file. */
export function readExr(path) {
  const bytes = readFileSync(path);
  if (bytes.readUInt32LE(0) !== 20000630) throw new Error(`${path}: not an EXR file`);
  let at = 8;
  const attributes = new Map();
  const name = () => {
    const end = bytes.indexOf(0, at);
    const text = bytes.toString("latin1", at, end);
    at = end + 1;
    return text;
  };
  for (let key = name(); key !== ""; key = name()) {
    name(); // its type
    const size = bytes.readUInt32LE(at);
    attributes.set(key, bytes.subarray(at + 4, at + 4 + size));
    at += 4 + size;
  }
  const channels = attributes.get("channels");
  if (
    channels.toString("latin1", 0, 2) !== "Y\0" ||
    channels.readUInt32LE(2) !== 2 ||
    channels[channels.length - 1] !== 0
  ) {
    throw new Error(`${path}: not one channel Y of floats`);
  }
  const box = attributes.get("dataWindow");
  const [x0, y0, x1, y1] = [0, 4, 8, 12].map((offset) => box.readInt32LE(offset));
  const [w, h] = [x1 - x0 + 1, y1 - y0 + 1];
  const rows = kRowsOfBlock[attributes.get("compression")[0]];
  if (rows === undefined) throw new Error(`${path}: another compression than ZIP`);

  const y = new Float32Array(w * h);
  at += 8 * Math.ceil(h / rows); // the table of offsets: blocks follow in order
  for (let block = 0; block < Math.ceil(h / rows); ++block) {
    const first = bytes.readInt32LE(at) - y0;
    const size = bytes.readUInt32LE(at + 4);
    const count = w * Math.min(rows, h - first);
    const stored = bytes.subarray(at + 8, at + 8 + size);
    const data = size === 4 * count ? stored : unpredicted(inflateSync(stored));
    for (let i = 0; i < count; ++i) y[first * w + i] = data.readFloatLE(4 * i);
    at += 8 + size;
  }
  return { w, h, y };
}

/** Sums of differences first, then the two halves are the bytes at even and at odd places. */
function unpredicted(coded) {
  for (let i = 1; i < coded.length; ++i) coded[i] = (coded[i - 1] + coded[i] - 128) & 255;
  const out = Buffer.alloc(coded.length);
  const half = Math.ceil(coded.length / 2);
  for (let i = 0; i < coded.length; ++i) out[i] = coded[(i >> 1) + (i & 1 ? half : 0)];
  return out;
}
