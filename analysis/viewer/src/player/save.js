/** Saves pictures as PNG, and animations as WebM, or as animated PNG if the browser cannot record WebM. */
import { ticksOf } from "./bar.js";

/**
 * Draws the player's picture onto another canvas, with the labels that the picture lacks.
 * @param {CanvasRenderingContext2D} context as large as the player's canvas and a strip below it
 * @param {{canvas: HTMLCanvasElement, ratio: number, cells: object[], time: number, bar: object|null,
 *          look: {paper: string, ink: string}}} shown
 */
export function compose(context, { canvas, ratio, cells, time, bar, look }) {
  const { width, height } = context.canvas;
  context.fillStyle = look.paper;
  context.fillRect(0, 0, width, height);
  context.drawImage(canvas, 0, 0);
  const font = (size, weight = 400) => `${weight} ${size * ratio}px system-ui, "DejaVu Sans", sans-serif`;
  context.textBaseline = "top";
  context.textAlign = "left";
  for (const { x, y, width: wide, label } of cells) {
    context.font = font(13, 600);
    context.fillStyle = look.label;
    context.fillText(fitted(context, label, (wide - 20) * ratio), (x + 10) * ratio, (y + 8) * ratio);
  }
  const line = canvas.height + 10 * ratio;
  context.font = font(13);
  context.fillStyle = look.ink;
  context.fillText(`t = ${time.toFixed(2)} s`, 10 * ratio, line);
  if (bar) drawBar(context, bar, font, ratio, line);
}

export const STRIP = 40; // pixels of the page below the picture

function drawBar(context, { quantity, range, colours }, font, ratio, line) {
  const wide = Math.min(220 * ratio, context.canvas.width * 0.4), right = context.canvas.width - 14 * ratio;
  const left = right - wide;
  for (let i = 0; i < 256; ++i) {
    context.fillStyle = `#${colours.substr(6 * i, 6)}`;
    context.fillRect(left + (i * wide) / 256, line, wide / 256 + 1, 9 * ratio);
  }
  const ink = context.canvas.dataset.ink;
  context.fillStyle = ink;
  context.font = font(10.5);
  context.textAlign = "center";
  const ends = [{ share: 0, text: String(Number(range[0].toPrecision(3))) },
                { share: 1, text: String(Number(range[1].toPrecision(3))) }];
  for (const { share, text } of [...ends, ...ticksOf(quantity, range)])
    context.fillText(text, left + share * wide, line + 12 * ratio);
  context.textAlign = "right";
  context.font = font(12);
  const unit = quantity.unit && quantity.unit !== "1" ? ` (${quantity.unit})` : "";
  context.fillText(`${quantity.name}${quantity.symbol ? `, ${quantity.symbol}` : ""}${unit}`, left - 14 * ratio, line - ratio);
}

function fitted(context, text, width) {
  if (context.measureText(text).width <= width) return text;
  let end = text.length;
  while (end > 1 && context.measureText(`${text.slice(0, end)}…`).width > width) --end;
  return `${text.slice(0, end)}…`;
}

/** The WebM type that this browser can record; null if it cannot record WebM. */
export function webmType() {
  if (typeof MediaRecorder === "undefined") return null;
  return ["video/webm;codecs=vp8", "video/webm;codecs=vp9", "video/webm"] // fastest to encode first
    .find((type) => MediaRecorder.isTypeSupported(type)) ?? null;
}

/**
 * Records a canvas in real time while `play` draws pictures onto it.
 * @param {HTMLCanvasElement} canvas @param {string} type
 * @param {(drawn: () => void) => Promise<void>} play calls drawn() after each picture
 */
export async function recordWebm(canvas, type, play) {
  const stream = canvas.captureStream(0);
  const [track] = stream.getVideoTracks();
  const recorder = new MediaRecorder(stream, { mimeType: type, videoBitsPerSecond: 12_000_000 });
  const parts = [];
  recorder.ondataavailable = (event) => event.data.size && parts.push(event.data);
  const stopped = new Promise((resolve, reject) => {
    recorder.onstop = resolve;
    recorder.onerror = (event) => reject(event.error ?? new Error("the browser stopped recording"));
  });
  recorder.start();
  await play(() => track.requestFrame());
  recorder.stop();
  await stopped;
  track.stop();
  return new Blob(parts, { type: "video/webm" });
}
