// The interactive parts of a page: embeds the Bokeh figures, fills the maps, reads what is under the pointer, draws the section.
"use strict";
const tabor = (() => {
const HOLE = 65535, NEAR = 14;  // code of no value; pixels on the screen
const STATES = ["no contact", "contact, dry", "contact, dry, saturated", "contact, wet", "contact, wet, saturated"];
const element = (id) => document.getElementById(id);
const json = (id) => JSON.parse(element(id).textContent);
const digits = (value, n = 4) => Number.isFinite(value) ? String(Number(value.toPrecision(n))).replace("-", "\u2212") : "none";

// Pictures stay pictures of pixels where they are drawn larger than they are.
const draw = CanvasRenderingContext2D.prototype.drawImage;
CanvasRenderingContext2D.prototype.drawImage = function (image, ...place) {
  if (image instanceof HTMLImageElement && place.length == 4) this.imageSmoothingEnabled = place[2] < 2 * image.naturalWidth;
  return draw.call(this, image, ...place);
};

// 16-bit codes of a coarse array: differences along rows, high bytes first, deflated.
async function unpack(array) {
  const packed = Uint8Array.from(atob(array.data), (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  const n = array.rows * array.columns, codes = new Uint16Array(n);
  for (let i = 0; i < n; i++) {
    const difference = bytes[i] << 8 | bytes[n + i];
    codes[i] = i % array.columns ? codes[i - 1] + difference : difference;
  }
  return codes;
}

async function canvasOf(url) {
  const image = new Image(), canvas = document.createElement("canvas");
  image.src = url;
  await image.decode();
  [canvas.width, canvas.height] = [image.naturalWidth, image.naturalHeight];
  canvas.getContext("2d", {willReadFrequently: true}).drawImage(image, 0, 0);
  return canvas;
}

class Coarse {
  constructor(array, codes) { Object.assign(this, array, {codes}); }
  // Of the sample in row j and column i.
  at(j, i) {
    const code = this.codes[j * this.columns + i];
    return code == HOLE ? NaN : this.low + this.step * code;
  }
}

class Maps {
  constructor(data, doc) {
    this.data = data;
    this.doc = doc;
    this.pictures = new Map();
    for (const image of document.querySelectorAll(`#${data.name} img[id]`)) this.pictures.set(image.id, image.src);
    [this.contact, this.film] = data.first;
    this.line = data.line.map(([x, y]) => [x + 0.5, y + 0.5]);  // in pixels of the scan
    this.grabbed = -1;
    this.arrays = new Map();
  }

  async start() {
    await Promise.all([this.data.height, ...this.data.contacts.map((contact) => contact.gap), ...this.data.films]
      .filter(Boolean).map(async (map) => this.arrays.set(map, new Coarse(map.array, await unpack(map.array)))));
    for (const which of ["contact", "film"]) this.follow(which);
    for (const [name, turn] of [["along", 0], ["across", 1]]) {
      const button = element(`${this.data.name}_${name}`);
      if (button) button.addEventListener("click", () => this.turn(turn));
    }
    element(`${this.data.name}_csv`).addEventListener("click", (event) => this.saveSection(event.currentTarget));
    for (const link of document.querySelectorAll(`#${this.data.name} a[data-panel]`)) {
      link.addEventListener("click", () => this.saveMap(link));
    }
    const grid = element(`${this.data.name}_grid`);
    grid.addEventListener("pointerdown", (event) => this.grab(event), true);
    window.addEventListener("pointerup", () => { this.grabbed = -1; }, true);
    this.show();
    return this;
  }

  follow(which) {
    const list = element(`${this.data.name}_${which}`);
    if (list) list.addEventListener("change", () => { this[which] = Number(list.value); this.show(); });
  }

  model(name) { return this.doc.get_model_by_name(`${this.data.name}_${name}`); }

  parts() {
    const {height, contacts, films} = this.data, state = contacts[this.contact], film = films[this.film];
    return {height, gap: state && state.gap, film, state};
  }

  show() {
    const parts = this.parts();
    for (const panel of ["height", "state", "gap", "film"]) {
      const part = parts[panel];
      if (!element(`${this.data.name}_${panel}_still`)) continue;
      const still = this.picture(panel, part && part.picture);
      if (panel == "state") this.picture("state_wet", parts.film ? parts.film.wet : `${this.data.name}_wet`);
      still.alt = `${this.title(panel)}${part ? "" : ": not on this page"}`;
      element(`${this.data.name}_${panel}_title`).textContent = still.alt;
      if (part && part.limits) this.bar(panel, part);
    }
    this.loadState(parts);
    this.section();
  }

  // Shows a picture in a panel and in the page that is printed.
  picture(panel, name) {
    const url = name ? this.pictures.get(name) : "", still = element(`${this.data.name}_${panel}_still`);
    this.model(panel).data = {url: [url]};
    still.src = url || "data:,";
    return still;
  }

  // The ends and the middle of a panel's colours.
  bar(panel, {limits: [low, high], unit: [factor, unit]}) {
    const shown = [low, (low + high) / 2, high].map((value) => digits(value * factor, 3)), places = element(`${this.data.name}_${panel}_ends`).children;
    shown.forEach((text, k) => { places[k].textContent = k < 2 ? text : `${text} ${unit}`; });
  }

  title(panel) {
    const {contacts, films} = this.data, contact = contacts[this.contact], film = films[this.film];
    const at = contact ? ` at ${contact.label}` : "", oil = film ? film.label : "";
    return {height: "Height about the mean", state: `Contact${at}${film ? ` with ${oil}` : ""}`, gap: `Gap${at}`,
            film: `Lubricant, ${oil}`}[panel];
  }

  // Every pixel of the layers of the contact picture, to be asked for its class.
  async loadState({state, film}) {
    this.canvases = null;
    const names = [state && state.picture, film && film.wet].filter(Boolean);
    if (!state) return;
    const canvases = await Promise.all(names.map((name) => canvasOf(this.pictures.get(name))));
    if (this.parts().state == state && this.parts().film == film) this.canvases = canvases;
  }

  // 0 to 4, as STATES; x, y in pixels of the scan; NaN where it is unknown.
  state(x, y) {
    if (!this.canvases) return NaN;
    const [veil, wet] = this.canvases.map((canvas) => this.pixel(canvas, x, y));
    if (veil[3] > 200) return 0;
    return 1 + (veil[3] < 50) + (wet && wet[0] < 116 ? 2 : 0);
  }

  pixel(canvas, x, y) {
    const step = this.data.thinning;
    return canvas.getContext("2d").getImageData(Math.floor(x / step), Math.floor(y / step), 1, 1).data;
  }

  // Column and row of the sample next to a pixel, and the pixel that it is of.
  sample(x, y) {
    const [nx, ny] = this.data.size, {columns, rows} = this.data.height.array;
    const i = Math.min(columns - 1, Math.max(0, Math.floor(x * columns / nx)));
    const j = Math.min(rows - 1, Math.max(0, Math.floor(y * rows / ny)));
    return {i, j, x: Math.floor((i + 0.5) * nx / columns), y: Math.floor((j + 0.5) * ny / rows)};
  }

  values(sample) {
    const parts = this.parts(), found = {};
    for (const panel of ["height", "film", "gap"]) {
      if (parts[panel]) found[panel] = this.arrays.get(parts[panel]).at(sample.j, sample.i);
    }
    return found;
  }

  pixels(x, y) {
    const [factor] = this.data.length, [px, py] = this.data.pixel;
    return [x / factor / px, y / factor / py];
  }

  // From a Bokeh event in the figure of one of the maps.
  moved(event, width) {
    const [x, y] = this.pixels(event.x, event.y), [nx, ny] = this.data.size;
    const range = this.model("x");
    this.reach = NEAR * (range.end - range.start) / width;
    this.pointer = [event.x, event.y];
    if (this.grabbed >= 0) {
      this.line[this.grabbed] = [Math.min(nx - 0.5, Math.max(0.5, x)), Math.min(ny - 0.5, Math.max(0.5, y))];
      this.section();
    }
    if (x < 0 || y < 0 || x >= nx || y >= ny) return;
    const [factor, unit] = this.data.length, [px, py] = this.data.pixel, sample = this.sample(x, y);
    const words = [`x ${digits((sample.x + 0.5) * px * factor, 6)} ${unit}`, `y ${digits((sample.y + 0.5) * py * factor, 6)} ${unit}`];
    const values = this.values(sample), parts = this.parts();
    for (const [panel, value] of Object.entries(values)) {
      const [scale, name] = parts[panel].unit;
      words.push(`${panel} ${Number.isFinite(value) ? `${digits(value * scale, 5)} ${name}` : "unknown"}`);
    }
    if (this.canvases) words.push(STATES[this.state(x, y)]);
    element(`${this.data.name}_reading`).textContent = words.join("  \u00b7  ");
    this.reading = {...sample, ...values, state: this.state(x, y)};
  }

  // The end of the section under the pointer follows it, and the map stays.
  grab(event) {
    if (!this.pointer) return;
    const [factor] = this.data.length, [px, py] = this.data.pixel;
    const distances = this.line.map(([x, y]) => Math.hypot(x * px * factor - this.pointer[0], y * py * factor - this.pointer[1]));
    const nearest = distances[0] < distances[1] ? 0 : 1;
    if (distances[nearest] > this.reach) return;
    this.grabbed = nearest;
    event.stopPropagation();
    event.preventDefault();
  }

  // The section through its middle, along x or along y, over the whole scan.
  turn(across) {
    const middle = [0, 1].map((axis) => (this.line[0][axis] + this.line[1][axis]) / 2), size = this.data.size;
    this.line = [0.5, size[across] - 0.5].map((place) => across ? [middle[0], place] : [place, middle[1]]);
    this.section();
  }

  section() {
    const [factor, unit] = this.data.length, [px, py] = this.data.pixel;
    this.model("line").data = {x: this.line.map((end) => end[0] * px * factor), y: this.line.map((end) => end[1] * py * factor)};
    const cut = this.cut(), [scale, name] = this.data.height.unit, finite = cut.solid.filter(Number.isFinite);
    const low = finite.reduce((a, b) => Math.min(a, b), Infinity), high = finite.reduce((a, b) => Math.max(a, b), -Infinity);
    const bottom = finite.length ? low - 0.12 * Math.max(high - low, 1e-12) : 0;
    const known = (values, other) => values.map((value, place) => (Number.isFinite(value) ? value : other(place)) * scale);
    const solid = known(cut.solid, () => bottom);
    this.model("section").data = {
      s: cut.s.map((s) => s * factor), bottom: cut.s.map(() => bottom * scale), solid,
      level: known(cut.level, (place) => solid[place] / scale), counter: cut.counter.map((value) => value * scale),
    };
    this.model("section_plot").left[0].axis_label = `z (${name})`;
    const length = cut.s[cut.s.length - 1] || 0;
    const place = (end) => `(${digits(end[0] * px * factor)}, ${digits(end[1] * py * factor)}) ${unit}`;
    const text = `Section from ${place(this.line[0])} to ${place(this.line[1])}, ${digits(length * factor)} ${unit} long`;
    element(`${this.data.name}_section_title`).textContent = text;
    element(`${this.data.name}_section_plot`).setAttribute("aria-label", text);
  }

  // {s, solid, level, counter} [m] at the samples along the line; NaN where unknown.
  cut() {
    const [[x0, y0], [x1, y1]] = this.line, [px, py] = this.data.pixel, [nx] = this.data.size, {columns} = this.data.height.array;
    const n = Math.max(2, Math.ceil(Math.hypot(x1 - x0, y1 - y0) * columns / nx) + 1);
    const found = {s: [], x: [], y: [], solid: [], level: [], counter: []};
    for (let k = 0; k < n; k++) {
      const t = k / (n - 1), x = x0 + t * (x1 - x0), y = y0 + t * (y1 - y0);
      const {height, film, gap} = this.values(this.sample(x, y));
      found.s.push(t * Math.hypot((x1 - x0) * px, (y1 - y0) * py));
      found.x.push(x * px);
      found.y.push(y * py);
      found.solid.push(height);
      found.level.push(film > 0 ? height + film : NaN);
      found.counter.push(gap === undefined ? NaN : height + gap);
    }
    return found;
  }

  saveSection(link) {
    const {s, x, y, solid, level, counter} = this.cut();
    const rows = s.map((_, k) => [s, x, y, solid, level, counter].map((column) => column[k]));
    this.save(link, "section.csv", [["s_m", "x_m", "y_m", "solid_m", "liquid_level_m", "counterface_m"], ...rows]);
  }

  saveMap(link) {
    const panel = link.dataset.panel, {rows, columns} = this.data.height.array, [px, py] = this.data.pixel, [nx, ny] = this.data.size;
    const part = this.parts()[panel], array = part && this.arrays.get(part);
    if (panel != "state" && !array) return;
    const places = (count, length, pixel) => Array.from({length: count}, (_, k) => (Math.floor((k + 0.5) * length / count) + 0.5) * pixel);
    const x = places(columns, nx, px), y = places(rows, ny, py);
    const value = (j, i) => array ? array.at(j, i) : this.state(x[i] / px, y[j] / py);
    const unit = panel == "state" ? "0_none_1_dry_2_dry_saturated_3_wet_4_wet_saturated" : "m";
    this.save(link, `${panel}.csv`, [[`${panel}_${unit} (row: y_m; column: x_m)`, ...x], ...y.map((place, j) => [place, ...x.map((_, i) => value(j, i))])]);
  }

  save(link, name, rows) {
    const cell = (value) => typeof value != "number" ? value : Number.isFinite(value) ? String(Number(value.toPrecision(7))) : "";
    link.href = URL.createObjectURL(new Blob([rows.map((row) => row.map(cell).join(",")).join("\n") + "\n"], {type: "text/csv"}));
    link.download = `${this.data.name}_${name}`;
  }
}

// Legends hide and show what they name.
function legends(doc) {
  for (const button of document.querySelectorAll("button.entry")) {
    button.addEventListener("click", () => {
      const shown = button.getAttribute("aria-pressed") != "true";
      button.setAttribute("aria-pressed", String(shown));
      for (const model of doc._all_models.values()) if (model.tags && model.tags.includes(button.dataset.tag)) model.visible = shown;
    });
  }
}

function links() {
  for (const link of document.querySelectorAll("a.picture")) link.href = element(link.dataset.of).src;
}

async function start() {
  links();
  const [views] = await Bokeh.embed.embed_items(json("bokeh-documents"), json("bokeh-places"));
  const doc = Bokeh.documents[Bokeh.documents.length - 1];
  document.documentElement.classList.add("interactive");
  legends(doc);
  const maps = {};
  for (const script of document.querySelectorAll("script.maps-data")) {
    const data = JSON.parse(script.textContent);
    maps[data.name] = await new Maps(data, doc).start();
  }
  Object.assign(api, {maps, doc, views});
}

const api = {maps: {}, moved(name, event, width) { if (api.maps[name]) api.maps[name].moved(event, width); }};
// Where an old browser lacks something, the still pictures stay.
api.ready = start().then(() => true, (error) => { console.error(error); document.documentElement.classList.remove("interactive"); return false; });
return api;
})();
