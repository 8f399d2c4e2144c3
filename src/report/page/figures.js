// What the page says in words and tables: figures of the records, with units and, where one is
// missing, the reason. Everything that comes from a run goes into the page as text, never as HTML.
"use strict";

const data = JSON.parse(document.getElementById("data").textContent);
const runs = data.runs;
const detailed = runs.filter((run) => run.frames);
const sequences = [...new Set(runs.map((run) => run.sequence))];
const variants = [...new Set(runs.map((run) => run.variant))];

/** Runs on the same sequence, for a part of the page; there the variant tells them apart. */
const ofSequence = (sequence) => runs.filter((run) => run.sequence === sequence);
const nameOf = (run) => (sequences.length > 1 ? run.variant : run.name);

/** Equal for equal variants where there are several sequences. */
const colorOf = (run) => runColor(sequences.length > 1 ? variants.indexOf(run.variant) : runs.indexOf(run));

/** Runs that an entry stands for. */
const repeats = (run) => run.record.repetition?.runs ?? 1;

/** An element with properties and children; strings become text. */
function element(tag, properties = {}, ...children) {
  const node = document.createElement(tag);
  for (const [key, value] of Object.entries(properties)) {
    if (key === "class") node.className = value;
    else if (key === "style") Object.assign(node.style, value);
    else node.setAttribute(key, value);
  }
  node.append(...children.filter((child) => child !== null && child !== undefined));
  return node;
}

/** The value at a place of a record ("time.computation_s.mean"); undefined when it has none. */
function at(record, place) {
  return place.split(".").reduce((value, key) => value?.[key], record);
}

/** Why a record has no value there: the reason for the place or for what would hold it. */
function reason(record, place) {
  const parts = place.split(".");
  for (let n = parts.length; n > 0; --n) {
    const why = record.absent[parts.slice(0, n).join(".")];
    if (why) return why;
  }
  return "the record does not have it";
}

/** Four significant digits at most, without an exponent. */
function text(value) {
  if (value === 0) return "0";
  const size = Math.floor(Math.log10(Math.abs(value)));
  return value.toFixed(Math.min(Math.max(3 - size, 0), 6));
}

/** A share as per cent, with a decimal where it is small. */
const percent = (share) => (share === undefined ? "" : `${(share * 100).toFixed(share < 0.1 ? 1 : 0)} %`);

/** The headline figures; `factor` turns the record's unit into the one shown. */
const figures = [
  {label: "Speed", place: "time.fps_computation", unit: "frames/s", factor: 1, best: Math.max,
   note: (r) => r.time.fps_wall ? `of computation; ${text(r.time.fps_wall)} with reading and drawing` : ""},
  {label: "Time per frame", place: "time.computation_s.mean", unit: "ms", factor: 1e3, best: Math.min,
   note: (r) => r.time.computation_s ? `95 % of frames within ${text(r.time.computation_s.p95 * 1e3)} ms` : ""},
  {label: "Trajectory error", place: "accuracy.over_processed.ate_m.se3.rmse", unit: "mm", factor: 1e3,
   best: Math.min, note: () => "ATE, RMSE after SE(3) alignment"},
  {label: "Relative error", place: "accuracy.over_processed.rpe_translation_m.rmse", unit: "mm", factor: 1e3,
   best: Math.min, note: (r) => `RPE, RMSE over ${r.accuracy.over_processed.rpe_delta_s} s`},
  {label: "Tracked", place: "frames.tracked", unit: "frames", factor: 1, best: null, whole: true,
   note: (r) => `of ${r.frames.processed} processed; ${r.frames.lost} lost, ${r.frames.dropped} dropped`},
  {label: "Energy per frame", place: "energy.total.joules_per_frame", unit: "J", factor: 1, best: Math.min,
   note: (r) => r.energy?.total ? `${text(r.energy.total.mean_w)} W on average` : ""},
  {label: "Peak memory", place: "memory.peak_resident_bytes", unit: "MiB", factor: 2 ** -20, best: Math.min,
   note: () => "resident set of the process"},
  {label: "Map", place: "memory.map_bytes", unit: "MiB", factor: 2 ** -20, best: Math.min,
   note: (r) => r.memory.map ? `stored as ${r.memory.map}` : ""},
];

function valueText(figure, value) {
  return figure.whole ? String(value) : text(value * figure.factor);
}

/** "[33.1, 34.2]": the interval over repeated runs, if there is one. */
function interval(record, place, factor = 1) {
  const repeated = record.repetition?.figures?.[place];
  if (repeated?.low === undefined) return null;
  return {low: repeated.low * factor, high: repeated.high * factor, runs: record.repetition.runs};
}

function intervalText(record, figure) {
  const range = interval(record, figure.place, figure.factor);
  return range ? `95 % [${text(range.low)}, ${text(range.high)}] over ${range.runs} runs` : "";
}

/** What a cell has below its figure; nothing where all runs agree. */
function rangeNode(range) {
  if (!range || text(range.low) === text(range.high)) return null;
  return element("span", {class: "range"}, `${text(range.low)} – ${text(range.high)}`);
}

function describe(record) {
  const p = record.provenance, size = record.sequence.computation_size;
  const parts = [record.sequence.name, p.backend, record.memory.map,
                 size ? `${size.width}x${size.height}` : undefined];
  return parts.filter((part) => part).join(" · ");
}

function card(record, figure) {
  const value = at(record, figure.place);
  const body = typeof value === "number"
    ? [element("div", {class: "value", "data-place": figure.place, "data-value": value},
               valueText(figure, value), " ", element("span", {class: "unit"}, figure.unit)),
       element("div", {class: "note"}, figure.note(record)),
       element("div", {class: "note"}, intervalText(record, figure))]
    : [element("div", {class: "value missing"}, "not measured"),
       element("div", {class: "note"}, reason(record, figure.place))];
  return element("div", {class: "card"}, element("div", {class: "label"}, figure.label), ...body);
}

/** A table; a cell is text, a node, or {text, class, ...attributes}. */
function table(head, rows) {
  const cell = (tag, content) => {
    if (content instanceof Node || typeof content !== "object") return element(tag, {}, content);
    const {text: words, nodes = [], ...attributes} = content;
    return element(tag, attributes, ...(words === undefined ? [] : [words]), ...nodes);
  };
  return element("div", {class: "scroll"}, element("table", {},
    element("thead", {}, element("tr", {}, ...head.map((content) => cell("th", content)))),
    element("tbody", {}, ...rows.map(([first, ...rest]) => element("tr", {},
      cell("th", first), ...rest.map((content) => cell("td", content)))))));
}

function runName(run, what) {
  return {class: "name", title: run.folder, nodes: [
    element("span", {class: "swatch", style: {background: colorOf(run)}}), run.name,
    typeof what === "string" ? element("span", {class: "range"}, what) : null]};
}

/** The best value of a figure among the runs that were given the same frames as this one. */
function bestOf(figure, run) {
  const values = runs.filter((other) => other.record.sequence.input_hash === run.record.sequence.input_hash)
    .map((other) => at(other.record, figure.place)).filter((v) => v !== undefined);
  return figure.best && values.length > 1 ? figure.best(...values) : undefined;
}

/** A row a run, the best of each figure bold. */
function comparisonTable() {
  const shown = figures.filter((figure) => runs.some((run) => at(run.record, figure.place) !== undefined));
  const head = ["Run", ...shown.map((figure) => ({class: "number", nodes: [figure.label,
    element("span", {class: "unit"}, figure.unit)]}))];
  return table(head, runs.map((run, i) => [runName(run, describe(run.record)),
    ...shown.map((figure) => {
      const value = at(run.record, figure.place);
      if (value === undefined) return {class: "number", text: "–", title: reason(run.record, figure.place)};
      const range = interval(run.record, figure.place, figure.factor);
      return {class: value === bestOf(figure, run) ? "number best" : "number", title: figure.note(run.record),
              "data-run": i, "data-place": figure.place, "data-value": value,
              nodes: [valueText(figure, value),
                      rangeNode(range)]};
    })]));
}

const atePlace = "accuracy.over_processed.ate_m.se3.rmse";

/** The paper's table: a row a sequence, a column a variant; in each cell the error, mm. */
function accuracyTable() {
  const cell = (sequence, variant) => {
    const run = runs.find((r) => r.sequence === sequence && r.variant === variant);
    if (!run) return {class: "number", text: "", title: "no such run"};
    const error = at(run.record, atePlace), published = run.record.accuracy.slambench1_ate_m;
    if (error === undefined) return {class: "number", text: "–", title: reason(run.record, atePlace)};
    const range = interval(run.record, atePlace, 1e3);
    return {class: "number", nodes: [
      element("span", {"data-place": atePlace, "data-value": error}, text(error * 1e3)),
      rangeNode(range),
      published ? element("span", {class: "range"}, `${text(published.mean * 1e3)}, max ${text(published.max * 1e3)}`)
                : element("span", {class: "range", title: reason(run.record, "accuracy.slambench1_ate_m")}, "–")]};
  };
  return table(["Sequence", ...variants.map((variant) => ({class: "number column", text: variant}))],
    sequences.map((sequence) => [{class: "name", text: sequence}, ...variants.map((variant) => cell(sequence, variant))]));
}

/** What a reader must know before believing a run. */
function warnings() {
  const list = [];
  const named = (run, words) => list.push(element("p", {class: "notice"},
    runs.length > 1 ? element("b", {}, run.name, ": ") : null, words));
  for (const run of runs) {
    const r = run.record;
    if (r.valid === false) named(run, `not a valid result: ${(r.invalid_reasons ?? []).join("; ")}`);
    if (r.complete === false) named(run, `not complete: ${r.incomplete_reason ?? "interrupted"}`);
    for (const sentence of r.conditions?.noise ?? []) named(run, sentence);
    if (r.repetition?.other_trajectory?.length) {
      named(run, `runs ${r.repetition.other_trajectory.join(", ")} of the repetition have another trajectory than the first`);
    }
  }
  return list;
}

/** The reasons why runs lack a figure, each once with the runs that it holds for. */
function absentNote(what, place, among = runs) {
  const reasons = new Map();
  for (const run of among) {
    if (at(run.record, place) !== undefined) continue;
    const why = reason(run.record, place);
    reasons.set(why, [...(reasons.get(why) ?? []), run.name]);
  }
  const words = [...reasons].map(([why, names]) =>
    among.length === 1 || names.length === among.length ? why : `${why} (${names.join(", ")})`);
  return element("p", {class: "absent"}, `${what}: ${words.join("; ")}.`);
}

/** Everything that was set or found, by "group.name": the text of each run. */
function facts() {
  const rows = new Map();
  const put = (group, name, i, value, setBy) => {
    const key = `${group}\u0000${name}`;
    if (!rows.has(key)) rows.set(key, {group, name, values: runs.map(() => ""), set: runs.map(() => "")});
    rows.get(key).values[i] = value;
    rows.get(key).set[i] = setBy ?? "";
  };
  runs.forEach((run, i) => {
    const r = run.record;
    for (const [group, parameters] of Object.entries(r.parameters)) {
      for (const [name, p] of Object.entries(parameters)) {
        put(`parameter, ${group}`, name, i, `${p.value}${p.unit ? ` ${p.unit}` : ""}`, p.set_by);
      }
    }
    for (const [name, value] of Object.entries(r.sequence)) {
      if (typeof value !== "object") put("sequence", name, i, String(value));
    }
    const {input_size: input, computation_size: computation, camera} = r.sequence;
    if (input) put("sequence", "input size", i, `${input.width}x${input.height} px`);
    if (computation) put("sequence", "computation size", i, `${computation.width}x${computation.height} px`);
    if (camera) put("sequence", "camera", i, `${camera.fx}, ${camera.fy}, ${camera.cx}, ${camera.cy} px`);
    for (const [name, value] of Object.entries(r.provenance)) {
      put("provenance", name, i, name.endsWith("_bytes") ? `${text(value / 2 ** 30)} GiB` : String(value));
    }
    const c = r.conditions ?? {};
    if (c.governor) put("conditions", "governor", i, c.governor);
    if (c.others_load !== undefined) put("conditions", "load of others", i, `${text(c.others_load)} processors`);
    if (c.cpu_frequency_hz) put("conditions", "processor frequency", i, `${text(c.cpu_frequency_hz.mean / 1e9)} GHz on average`);
    for (const [sensor, t] of Object.entries(c.temperature_c ?? {})) {
      put("conditions", `temperature, ${sensor}`, i, `${text(t.mean)} °C, at most ${text(t.max)} °C`);
    }
    if (c.throttled !== undefined) put("conditions", "throttled by heat", i, `${c.throttled} times`);
  });
  return [...rows.values()];
}

function factTable(rows) {
  const one = runs.length === 1;
  return table([one ? "" : "", "", ...(one ? ["Value", "Set by"] : runs.map((run) => runName(run)))],
    rows.map((row) => [{text: row.name}, {text: row.group, style: ""},
      ...(one ? [{class: "long", text: row.values[0]}, row.set[0]]
              : row.values.map((value, i) => ({class: "long", text: value || "–", title: row.set[i]})))]));
}

function counterRows() {
  const ratio = (a, b, digits = text) => (a === undefined || !b ? "–" : digits(a / b));
  const rows = [];
  for (const run of runs) {
    const counters = run.record.counters;
    if (!counters) continue;
    for (const [stage, c] of Object.entries(counters.stages)) {
      if (!c.cycles && !c.instructions) continue;
      const number = (words) => ({class: "number", text: words});
      rows.push([{class: "name", text: run.name}, stage,
        number(ratio(c.cycles, counters.frames * 1e6)), number(ratio(c.instructions, c.cycles)),
        number(ratio(c.cache_misses * 1e3, c.instructions)), number(ratio(c.branch_misses * 1e3, c.instructions))]);
    }
  }
  return rows;
}
