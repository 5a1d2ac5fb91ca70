// The interactive parts of a page: embeds the Bokeh figures, fills the maps, reads what is under the pointer, draws the section.
"use strict";
const tabor = (() => {
const NEAR = 14, SETTLED = 200, SAMPLE = 200000;  // pixels on the screen; ms without a move; values that tell the ends of colours
const PANELS = ["height", "film", "gap", "pressure"];  // of numbers, in the order of the reading
const element = (id) => document.getElementById(id);
const json = (id) => JSON.parse(element(id).textContent);
const minus = (text) => text.replace("-", "\u2212");
const digits = (value, n = 4) => Number.isFinite(value) ? minus(String(Number(value.toPrecision(n)))) : "none";

// Pictures stay pictures of pixels where they are drawn larger than they are.
const draw = CanvasRenderingContext2D.prototype.drawImage;
CanvasRenderingContext2D.prototype.drawImage = function (image, ...place) {
  if (image instanceof HTMLImageElement && place.length == 4) this.imageSmoothingEnabled = place[2] < image.naturalWidth;
  return draw.call(this, image, ...place);
};

async function inflated(text) {
  const packed = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// What a guess lacks, from its bytes: a plane of the low ones, a plane of the next ..., folded to 0, -1, 1, -2 ...
function lacking(bytes, planes, n) {
  const found = new Int32Array(n);
  for (let plane = 0; plane < planes; plane++) {
    for (let k = 0; k < n; k++) found[k] |= bytes[plane * n + k] << 8 * plane;
  }
  for (let k = 0; k < n; k++) found[k] = found[k] >>> 1 ^ -(found[k] & 1);
  return found;
}

// Whole steps of a map, row by row; encoding.py packs them. The codes come to stand where what they lack stood.
function completed(codes, columns, height, isLevel) {
  const base = height || new Int32Array(codes.length);
  for (let k = 0; k < codes.length; k++) {
    const left = k % columns > 0, above = k >= columns;
    let guess = 0;
    if (isLevel) {
      if (left && codes[k - 1] > 0) guess = codes[k - 1] + base[k - 1] - base[k];
      else if (above && codes[k - columns] > 0) guess = codes[k - columns] + base[k - columns] - base[k];
      guess = Math.max(0, guess);
    } else {
      if (left) guess += codes[k - 1] + base[k - 1];
      if (above) guess += codes[k - columns] + base[k - columns];
      if (left && above) guess -= codes[k - columns - 1] + base[k - columns - 1];
      guess -= base[k];
    }
    codes[k] += guess;
  }
  return codes;
}

// A picture of n pixels, [red, green, blue] of each by its place.
async function painted(columns, rows, colourOf) {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [columns, rows];
  const context = canvas.getContext("2d"), image = context.createImageData(columns, rows);
  for (let k = 0; k < columns * rows; k++) {
    const colour = colourOf(k);
    for (let part = 0; part < 3; part++) image.data[4 * k + part] = colour[part];
    image.data[4 * k + 3] = 255;
  }
  context.putImageData(image, 0, 0);
  return URL.createObjectURL(await new Promise((resolve) => canvas.toBlob(resolve)));
}

const bytesOf = (hex) => Uint8Array.from(hex.match(/../g), (pair) => parseInt(pair, 16));
const coloursOf = (hex) => { const bytes = bytesOf(hex); return Array.from({length: bytes.length / 3}, (_, k) => bytes.subarray(3 * k, 3 * k + 3)); };

class Maps {
  constructor(data, doc) {
    this.data = data;
    this.doc = doc;
    this.pictures = new Map();
    for (const image of document.querySelectorAll(`#${data.name} img[id]`)) this.pictures.set(image.id, image.src);
    [this.contact, this.film] = data.first;
    this.line = data.line.map(([x, y]) => [x + 0.5, y + 0.5]);  // in pixels of the scan
    this.grabbed = -1;
    this.codes = new Map();  // of arrays, once they are asked for
    this.colours = Object.fromEntries(Object.entries(data.colours).map(([panel, hex]) => [panel, coloursOf(hex)]));
    this.classes = data.classes.map((colour) => bytesOf(colour.slice(1)));
    this.states = ["no contact", ...["elastic", "saturated", "elastic", "saturated"].map((kind, k) =>
      `contact, ${data.films.length ? ["dry, ", "wet, "][k >> 1] : ""}${kind}`)];
    this.painted = new Map();  // pictures by panel: {part, url}
    this.now = {};
    this.loading = true;
  }

  async start() {
    this.started = true;
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
    const follow = element(`${this.data.name}_follow`);
    follow.addEventListener("change", () => { this.follows = follow.checked; this.show(); });
    for (const axis of ["x", "y"]) this.model(axis).change.connect(() => this.zoomed());
    await this.show();
    return this;
  }

  // Chooses what another scan's maps show, by its label.
  takeChoice(other) {
    for (const which of ["contact", "film"]) {
      const shown = other.data[`${which}s`][other[which]], place = this.data[`${which}s`].findIndex((item) => shown && item.label == shown.label);
      if (place < 0) continue;
      this[which] = place;
      const list = element(`${this.data.name}_${which}`);
      if (list) list.value = String(place);
    }
  }

  follow(which) {
    const list = element(`${this.data.name}_${which}`);
    if (list) list.addEventListener("change", () => { this[which] = Number(list.value); this.show(); });
  }

  // Colours follow a zoom once it rests.
  zoomed() {
    clearTimeout(this.resting);
    if (this.follows) this.resting = setTimeout(() => this.show(), SETTLED);
  }

  // The ends of a panel's colours [SI]: those of the whole map, or of its shown part.
  limits(panel, part, now) {
    if (!this.follows || !now[panel]) return part.limits;
    const values = this.shownValues(panel, now).sort();
    if (!values.length) return part.limits;
    const at = (share) => values[Math.round(share * (values.length - 1))], low = panel == "height" ? at(0.005) : 0, high = at(0.995);
    return high > low ? [low, high] : part.limits;
  }

  // Values of the grid's pixels that are seen, of a film and a pressure where there is any; a sample of many.
  shownValues(panel, now) {
    const {grid: [columns]} = this.data, [x, y] = [this.model("x"), this.model("y")], {part, codes} = now[panel];
    const bare = {film: now.wet, pressure: now.state}[panel], found = [];
    const ends = [[x.start, y.start], [x.end, y.end]].map(([a, b]) => this.cell(...this.pixels(a, b)));
    const [left, right] = [ends[0].i, ends[1].i].sort((a, b) => a - b), [top, bottom] = [ends[0].j, ends[1].j].sort((a, b) => a - b);
    const width = right - left + 1, n = width * (bottom - top + 1), step = Math.max(1, Math.floor(n / SAMPLE));
    for (let place = 0; place < n; place += step) {
      const k = (top + Math.floor(place / width)) * columns + left + place % width;
      if (codes[k] !== part.array.hole && (!bare || bare.codes[k])) found.push(this.valueOf(part, codes[k]));
    }
    return Float64Array.from(found);
  }

  model(name) { return this.doc.get_model_by_name(`${this.data.name}_${name}`); }

  // What is chosen, by panel.
  parts() {
    const {height, contacts, films} = this.data, state = contacts[this.contact], film = films[this.film];
    return {height, gap: state && state.gap, pressure: state && state.pressure, film, state};
  }

  // The codes of an array, unpacked once.
  unpacked(array) {
    if (!this.codes.has(array)) this.codes.set(array, this.unpack(array));
    return this.codes.get(array);
  }

  async unpack(array) {
    const [columns, rows] = this.data.grid, bytes = await inflated(array.data);
    const height = array.on_height ? await this.unpacked(this.data.height.array) : null;
    return completed(lacking(bytes, array.planes, columns * rows), columns, height, array.is_level);
  }

  // {panel: {part, codes}} of what is chosen, and classes of contact (`state`) and film (`wet`).
  async load() {
    const parts = this.parts(), found = {};
    const load = async (name, array, part) => { if (array) found[name] = {part, codes: await this.unpacked(array)}; };
    await Promise.all([...PANELS.map((panel) => load(panel, parts[panel] && parts[panel].array, parts[panel])),
      load("state", parts.state && parts.state.state, parts.state), load("wet", parts.film && parts.film.wet, parts.film)]);
    return found;
  }

  // Shows what is chosen, all of it at once: maps, section and reading never mix two choices.
  async show() {
    const wanted = this.wanted = [this.contact, this.film];
    this.loading = true;
    const now = await this.load(), parts = this.parts(), pictures = {};
    for (const panel of ["height", "state", "pressure", "gap", "film"]) {
      if (this.wanted === wanted && element(`${this.data.name}_${panel}_still`)) pictures[panel] = await this.layersOf(panel, parts, now);
    }
    if (this.wanted !== wanted) return;
    this.now = now;
    for (const [panel, layers] of Object.entries(pictures)) {
      const part = parts[panel], title = `${this.title(panel)}${part ? "" : ": not on this page"}`;
      for (const [layer, picture] of Object.entries(layers)) this.fill(layer, picture, title);
      element(`${this.data.name}_${panel}_title`).textContent = title;
      if (part && part.limits) this.bar(panel, part, this.limits(panel, part, now));
    }
    this.loading = false;
    this.section();
    this.read();
  }

  // {layer: {url, w, h}} of a panel, the size as a share of the scan's.
  async layersOf(panel, parts, now) {
    const part = parts[panel], whole = (name) => ({url: name ? this.pictures.get(name) : "", w: 1, h: 1});
    if (!part) return {[panel]: whole("")};
    if (panel == "state" && part.picture) return {state_wet: whole(parts.film ? parts.film.wet_picture : `${this.data.name}_wet`), state: whole(part.picture)};
    return {[panel]: part.picture && !(this.follows && panel != "state") ? whole(part.picture) : await this.ofGrid(panel, part, now)};
  }

  // The picture of the grid, painted where the one before is of something else.
  async ofGrid(panel, part, now) {
    const {grid: [columns, rows], size: [nx, ny], step} = this.data, before = this.painted.get(panel);
    const key = panel == "state" ? [part, now.wet && now.wet.codes] : [part, ...this.limits(panel, part, now)];
    if (!before || before.key.some((item, k) => item !== key[k])) {
      const url = await painted(columns, rows, this.colourOf(panel, now));
      if (before) setTimeout(() => URL.revokeObjectURL(before.url), 2000);
      this.painted.set(panel, {key, url});
    }
    return {url: this.painted.get(panel).url, w: columns * step / nx, h: rows * step / ny};
  }

  // The colour of a pixel of the grid.
  colourOf(panel, now) {
    if (panel == "state") return (k) => this.classes[this.classOf(k, now)];
    const {part, codes} = now[panel], table = this.colours[panel], [low, high] = this.limits(panel, part, now), {hole} = part.array;
    const bare = {film: now.wet, pressure: now.state}[panel], scale = 254 / (high - low || 1);
    return (k) => {
      if (codes[k] === hole || (bare && !bare.codes[k])) return table[0];
      return table[1 + Math.floor(Math.min(254, Math.max(0, (this.valueOf(part, codes[k]) - low) * scale)))];
    };
  }

  // [SI] of a code: the nearest number to a decimal one.
  valueOf({power}, code) { return power <= 0 ? code / 10 ** -power : code * 10 ** power; }

  // 0 none, 1 dry and elastic, 2 dry and saturated, 3 and 4 the same wet.
  classOf(k, now = this.now) {
    const state = now.state ? now.state.codes[k] : 0;
    return state && now.wet && now.wet.codes[k] ? state + 2 : state;
  }

  // A picture in a panel and in the page that is printed.
  fill(layer, {url, w, h}, alt) {
    const [factor] = this.data.length, [nx, ny] = this.data.size, [px, py] = this.data.pixel, still = element(`${this.data.name}_${layer}_still`);
    this.model(layer).data = {url: [url], w: [nx * px * factor * w], h: [ny * py * factor * h]};
    Object.assign(still, {src: url || "data:,", alt});
    Object.assign(still.style, {width: `${100 * w}%`, height: `${100 * h}%`});
  }

  // The ends and the middle of a panel's colours.
  bar(panel, {unit: [factor, unit]}, [low, high]) {
    const n = 3 + Math.max(0, Math.floor(Math.log10(Math.max(Math.abs(low), Math.abs(high)) / (high - low))));
    const shown = [low, (low + high) / 2, high].map((value) => digits(value * factor, n)), places = element(`${this.data.name}_${panel}_ends`).children;
    shown.forEach((text, k) => { places[k].textContent = k < 2 ? text : `${text} ${unit}`; });
  }

  title(panel) {
    const {contacts, films, of_contact: of} = this.data, contact = contacts[this.contact], film = films[this.film];
    const at = contact ? ` at ${contact.label}` : "", oil = film ? film.label : "";
    return {height: this.data.heading, state: `Contact${of}${at}${film ? ` with ${oil}` : ""}`, pressure: `Contact pressure${of}${at}`, gap: `Gap${of}${at}`,
            film: `Lubricant, ${oil}`}[panel];
  }

  // Column, row and place of the grid's pixel for a pixel of the scan, and that pixel.
  cell(x, y) {
    const {grid: [columns, rows], step} = this.data;
    const i = Math.min(columns - 1, Math.max(0, Math.floor(x / step))), j = Math.min(rows - 1, Math.max(0, Math.floor(y / step)));
    return {i, j, k: j * columns + i, x: i * step, y: j * step};
  }

  // 0 to 4, as classOf, of the grid's pixel there; x, y in pixels of the scan.
  state(x, y) { return this.now.state ? this.classOf(this.cell(x, y).k) : NaN; }

  // A map's value in a place of the grid [SI]; NaN where it is unknown, nothing where the page has no such map.
  value(panel, k) {
    if (!this.now[panel]) return undefined;
    const {part, codes} = this.now[panel];
    return codes[k] === part.array.hole ? NaN : this.valueOf(part, codes[k]);
  }

  // A map's value with its unit, in all the digits that the page has.
  words(panel, k) {
    const {part, codes} = this.now[panel], [factor, unit] = part.unit, places = Math.round(Math.log10(1 / factor)) - part.power;
    return codes[k] === part.array.hole ? "unknown" : `${minus((codes[k] / 10 ** places).toFixed(Math.max(0, places)))} ${unit}`;
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
    this.pointed = [x, y];
    this.read();
  }

  // Tells the values of the pixel last pointed at, of what is chosen.
  read() {
    if (!this.pointed || this.loading) return;
    const [factor, unit] = this.data.length, [px, py] = this.data.pixel, cell = this.cell(...this.pointed), {k} = cell;
    const words = [`x ${digits((cell.x + 0.5) * px * factor, 6)} ${unit}`, `y ${digits((cell.y + 0.5) * py * factor, 6)} ${unit}`];
    const panels = PANELS.filter((panel) => this.now[panel]);
    words.push(...panels.map((panel) => `${panel} ${this.words(panel, k)}`));
    if (this.now.state) words.push(this.states[this.classOf(k)]);
    element(`${this.data.name}_reading`).textContent = words.join("  \u00b7  ");
    this.reading = {...cell, ...Object.fromEntries(panels.map((panel) => [panel, this.value(panel, k)])), state: this.state(...this.pointed)};
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
    if (this.loading) return;
    const [factor, unit] = this.data.length, [px, py] = this.data.pixel, [nx, ny] = this.data.size;
    this.model("line").data = {x: this.line.map((end) => end[0] * px * factor), y: this.line.map((end) => end[1] * py * factor)};
    for (const line of document.querySelectorAll(`#${this.data.name} .cut line`)) {
      this.line.forEach(([x, y], end) => { line.setAttribute(`x${end + 1}`, 100 * x / nx); line.setAttribute(`y${end + 1}`, 100 * y / ny); });
    }
    const cut = this.cut(), [scale, name] = this.data.height.unit, finite = [...cut.solid, ...cut.counter].filter(Number.isFinite);
    const low = finite.reduce((a, b) => Math.min(a, b), Infinity), high = finite.reduce((a, b) => Math.max(a, b), -Infinity);
    const bottom = finite.length ? low - 0.12 * Math.max(high - low, 1e-12) : 0;
    const known = (values, other) => values.map((value, place) => (Number.isFinite(value) ? value : other(place)) * scale);
    const solid = known(cut.solid, () => bottom), upTo = (place) => solid[place] / scale;
    this.model("section").data = {
      s: cut.s.map((s) => s * factor), bottom: cut.s.map(() => bottom * scale), solid,
      level: known(cut.level, upTo), counter: cut.counter.map((value) => value * scale),
      flattened: known(cut.counter.map((value, place) => Math.min(value, cut.solid[place])), upTo),
    };
    this.model("section_plot").left[0].axis_label = `z (${name})`;
    const length = cut.s[cut.s.length - 1] || 0;
    const place = (end) => `(${digits(cut.x[end] * factor)}, ${digits(cut.y[end] * factor)}) ${unit}`;
    const text = `Section from ${place(0)} to ${place(cut.s.length - 1)}, ${digits(length * factor)} ${unit} long`;
    element(`${this.data.name}_section_title`).textContent = text;
    element(`${this.data.name}_section_plot`).setAttribute("aria-label", text);
  }

  // {s, x, y, solid, level, counter} [m] of the pixels of the grid along the line, each once; NaN where unknown.
  cut() {
    const [from, to] = this.line.map(([x, y]) => this.cell(x, y)), {grid: [columns], step, pixel: [px, py]} = this.data;
    const n = Math.max(1, Math.abs(to.i - from.i), Math.abs(to.j - from.j));
    const length = Math.hypot((to.x - from.x) * px, (to.y - from.y) * py), found = {s: [], x: [], y: [], solid: [], level: [], counter: []};
    for (let place = 0; place <= n; place++) {
      const i = Math.round(from.i + place / n * (to.i - from.i)), j = Math.round(from.j + place / n * (to.j - from.j)), k = j * columns + i;
      const height = this.value("height", k), film = this.value("film", k), gap = this.value("gap", k);
      found.s.push(place / n * length);
      found.x.push((i * step + 0.5) * px);
      found.y.push((j * step + 0.5) * py);
      found.solid.push(height);
      found.level.push(film > 0 ? height + film : NaN);
      found.counter.push(gap === undefined ? NaN : height + gap);
    }
    return found;
  }

  saveSection(link) {
    const {s, x, y, solid, level, counter} = this.cut();
    const rows = s.map((_, k) => [s, x, y, solid, level, counter].map((column) => column[k]));
    this.save(link, `section${this.fileOf("section")}.csv`, [["s_m", "x_m", "y_m", "solid_m", "liquid_level_m", "counterface_m"], ...rows]);
  }

  saveMap(link) {
    const panel = link.dataset.panel, {grid: [columns, rows], step, pixel: [px, py]} = this.data;
    if (!this.now[panel]) return;
    const x = Array.from({length: columns}, (_, i) => (i * step + 0.5) * px);
    const value = (k) => panel == "state" ? this.classOf(k) : this.value(panel, k);
    const unit = {state: "0_none_1_dry_elastic_2_dry_saturated_3_wet_elastic_4_wet_saturated", pressure: "Pa"}[panel] || "m";
    const row = (_, j) => [(j * step + 0.5) * py, ...x.map((_, i) => value(j * columns + i))];
    this.save(link, `${panel}${this.fileOf(panel)}.csv`, [[`${panel}_${unit} (row: y_m; column: x_m)`, ...x], ...Array.from({length: rows}, row)]);
  }

  save(link, name, rows) {
    const cell = (value) => typeof value != "number" ? value : Number.isFinite(value) ? String(Number(value.toPrecision(12))) : "";
    link.href = URL.createObjectURL(new Blob([rows.map((row) => row.map(cell).join(",")).join("\n") + "\n"], {type: "text/csv"}));
    link.download = `${this.data.file}_${name}`;
  }

  // What of the choice a table belongs to, in the name of its file.
  fileOf(panel) {
    const {contacts, films} = this.data, contact = panel == "height" || panel == "film" ? undefined : contacts[this.contact];
    const film = ["film", "state", "section"].includes(panel) ? films[this.film] : undefined;
    return [contact, film].map((part) => part ? `_${part.file}` : "").join("");
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

// One scan's maps are seen, and read once they are; another's come with the same contact and film where it has them.
async function chosen(maps) {
  const all = Object.values(maps), list = element("maps_scan");
  let seen = all[0];
  if (seen) await seen.start();
  if (list) list.addEventListener("change", async () => {
    const next = maps[list.value], before = seen;
    seen = next;
    for (const one of all) element(one.data.name).hidden = one != next;
    next.takeChoice(before);
    await (next.started ? next.show() : next.start());
  });
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
    maps[data.name] = new Maps(data, doc);
  }
  Object.assign(api, {maps, doc, views});
  await chosen(maps);
}

const api = {maps: {}, moved(name, event, width) { if (api.maps[name]) api.maps[name].moved(event, width); }};
// Where an old browser lacks something, the still pictures stay.
api.ready = start().then(() => true, (error) => { console.error(error); document.documentElement.classList.remove("interactive"); return false; });
return api;
})();
