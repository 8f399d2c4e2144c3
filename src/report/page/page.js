// Builds the page: its sections in order, each with charts or the reason why it has none, then
// draws the charts, and again when light turns to dark.

const charts = [];

/** A place for a chart that is drawn later. */
function chart(id, build, words) {
  const place = element("div", {class: "chart", id, role: "img", "aria-label": words});
  charts.push({id, build, place});
  return place;
}

/** The chart, or one for each of several sequences; `among` tells which runs it has. */
function panels(id, build, words, has) {
  if (sequences.length === 1) return [chart(id, (colors) => build(colors, runs), words)];
  const shown = sequences.filter((sequence) => ofSequence(sequence).some(has));
  const long = variants.some((variant) => variant.length > 18);
  return [element("div", {class: long ? "panels wide" : "panels"}, ...shown.map((sequence, k) => element("div", {class: "panel"},
    element("h3", {}, sequence),
    chart(`${id}-${k + 1}`, (colors) => build(colors, ofSequence(sequence)), `${words}, ${sequence}`))))];
}

const caption = (words) => element("p", {class: "caption"}, words);
const absent = (words) => element("p", {class: "absent"}, words);

/** What the frame by frame charts leave out. */
function detailNote() {
  const {detailed_runs: shown, frame_step: step} = data.limits;
  const notes = [];
  if (shown < runs.length) {
    notes.push(sequences.length > 1 ? `Shown are ${shown} of ${runs.length} runs, those on ${detailed[0].sequence}.`
                                    : `Shown are the first ${shown} of ${runs.length} runs.`);
  }
  if (step > 1) notes.push(`Lines have every ${step}th frame, so that the file stays small.`);
  return notes.length ? caption(notes.join(" ")) : null;
}

function overview() {
  const one = runs.length === 1;
  return [one ? element("div", {class: "cards"}, ...figures.map((figure) => card(runs[0].record, figure))) : comparisonTable(),
          one ? null : caption("Bold: the best of each figure among runs of the same frames. A dash: not measured; hover for the reason." +
                               (runs.some((run) => repeats(run) > 1) ? " Figures of repeated runs are medians over all of them, with the 95 % interval of the median below; curves, paths and pictures are of the run of median time." : "")),
          ...warnings()];
}

function accuracy() {
  if (runs.length < 2) return null;
  if (!runs.some((run) => at(run.record, atePlace) !== undefined)) return [absentNote("No trajectory was judged", atePlace)];
  const published = runs.some((run) => run.record.accuracy.slambench1_ate_m);
  return [caption("Absolute trajectory error, mm: RMSE after SE(3) alignment" +
                  (published ? "; below it the figure that SLAMBench 1 published, mean and largest (the paper's table has the largest, in cm)." : ".") +
                  " A dash: not measured; hover for the reason."),
          accuracyTable()];
}

function stages() {
  if (!runs.some((run) => run.record.time.stages)) return [absentNote("No stage times", "time.stages")];
  const missing = runs.some((run) => !run.record.time.stages) ? absentNote("Not shown", "time.stages") : null;
  return [caption("Mean time of a processed frame by stage; reading and drawing are not part of it. FPS is 1 / mean time."),
          ...panels("chart-stages", stageChart, "Stage times of each run with frames per second", (run) => run.record.time.stages), missing];
}

function kernels() {
  const shown = runs.filter((run) => run.record.time.kernels);
  if (!shown.length) return [absentNote("No kernel times", "time.kernels")];
  const has = (run) => run.record.time.kernels;
  if (shown.length <= 4 && sequences.length === 1) {
    return [caption("Mean time of each kernel a frame, all its calls together, with its share of computation, in the order of the pipeline."),
            ...panels("chart-kernels", kernelBars, "Time of each kernel", has)];
  }
  const shares = [caption("Share of each kernel in the computation of a run. Kernels of one stage have shades of one colour."),
                  ...panels("chart-kernels", kernelShares, "Share of each kernel in each run", has)];
  return sequences.length > 1 ? shares
    : [...shares, caption("The same in numbers, per cent. A dash: the run did not call that kernel."),
       chart("chart-kernel-map", (colors) => kernelMap(colors, runs), "Share of each kernel in each run, in numbers")];
}

function alongTheSequence() {
  if (!detailed.length) return [absent("No run is shown frame by frame: --detail 0.")];
  return [caption("Time of computation of every processed frame; warm-up frames may lie beyond the axis, double-click to see them. Crosses are lost frames; ticks on the axis are frames that came too late and were dropped."),
          detailNote(), chart("chart-times", timeChart, "Time of computation along the sequence")];
}

function error() {
  if (!detailed.length) return [absent("No run is shown frame by frame: --detail 0.")];
  const missing = detailed.filter((run) => !hasErrors(run));
  const note = missing.length ? absentNote("Not judged", "accuracy.over_processed.ate_m.se3.rmse", missing) : null;
  if (missing.length === detailed.length) return [note];
  return [caption("Distance of each estimated position to the true one" +
                  (detailed.length > 1 ? ", after SE(3) alignment." : ", under two alignments.")),
          detailNote(), chart("chart-errors", errorChart, "Trajectory error along the sequence"), note];
}

function path() {
  if (!detailed.some((run) => run.paths.estimate.up.length)) return [absent("No run has an estimated path.")];
  const notes = new Map();
  for (const run of detailed) {
    const words = run.paths.truth_note;
    if (words) notes.set(words, [...(notes.get(words) ?? []), run.name]);
  }
  const words = [...notes].map(([note, names]) => (names.length === detailed.length ? note : `${note} (${names.join(", ")})`));
  return [caption("Camera path seen from the start camera, metres. Drag to turn, scroll to come nearer."), detailNote(),
          element("div", {class: "pair"},
            webgl() ? chart("chart-path", pathChart, "Estimated and true path in three dimensions")
                    : absent("The path in three dimensions needs WebGL, which this browser does not offer."),
            chart("chart-above", pathFromAbove, "Estimated and true path from above")),
          caption(`Left: in three dimensions; right: from above, as the start camera stood. Ground truth: ${words.join("; ")}.`)];
}

function webgl() {
  return Boolean(document.createElement("canvas").getContext("webgl"));
}

function energy() {
  const shown = runs.filter((run) => run.record.energy);
  const note = shown.length < runs.length ? absentNote("Energy was not measured", "energy") : null;
  if (!shown.length) return [note];
  const number = (value) => ({class: "number", text: value === undefined ? "–" : text(value)});
  const rows = shown.flatMap((run) => [...Object.entries(run.record.energy.rails),
      ...(run.record.energy.total ? [["total", run.record.energy.total]] : [])].map(([name, rail]) => [
    {class: "name", text: run.name}, name, {class: "long", text: rail.sensor ?? ""}, number(rail.joules_per_frame), number(rail.mean_w), number(rail.peak_w),
    number(rail.idle_w), number(rail.joules), number(rail.energy_delay_js)]));
  const head = (words, unit) => ({class: "number", nodes: [words, element("span", {class: "unit"}, unit)]});
  const whole = shown.length > 1 && wholeRails(shown).length > 0;
  return [caption(whole ? "Energy of a processed frame by the rails that add up to the total, with the mean time of computation."
                        : "Energy of a processed frame by rail. A rail within another is part of it and not added to the total again."),
          ...(whole ? panels("chart-energy", energyStack, "Energy of a frame by rail", (run) => run.record.energy?.total)
                    : panels("chart-energy", energyChart, "Energy of a frame by rail", (run) => run.record.energy)),
          ...powerOverTime(),
          table(["Run", "Rail", "Sensor", head("a frame", "J"), head("mean", "W"), head("peak", "W"), head("idle", "W"), head("run", "J"), head("energy-delay", "J s")], rows),
          note];
}

function powerOverTime() {
  const rails = sampledRails();
  if (!rails.length) return [];
  const words = "Power while the frames were processed, as the sensors said";
  if (detailed.length > 1 && rails.length > 1) {
    return [caption(`${words}, by rail.`), detailNote(),
            element("div", {class: "panels"}, ...rails.map((rail, k) => element("div", {class: "panel"}, element("h3", {}, rail),
              chart(`chart-power-${k + 1}`, (colors) => powerChart(colors, rail), `Power of ${rail} over time`))))];
  }
  return [caption(`${words}, and what it adds up to. The energy of the whole run is in the table below.`), detailNote(),
          element("div", {class: "panels"}, chart("chart-power", powerChart, "Power of each rail over time"),
                  chart("chart-energy-so-far", energySoFarChart, "Energy of each rail over time"))];
}

function counters() {
  const rows = counterRows();
  if (!rows.length) return null;
  const head = (words, unit) => ({class: "number", nodes: [words, element("span", {class: "unit"}, unit)]});
  return [caption("Events of all threads in user space, by stage."),
          table(["Run", "Stage", head("cycles a frame", "million"), head("instructions", "a cycle"),
                 head("cache misses", "a thousand instructions"), head("branch misses", "a thousand instructions")], rows)];
}

function tradeOff() {
  if (runs.length < 2) return [absent("A trade-off needs several runs: slambench report RUN RUN...")];
  const count = judged().length;
  if (count < 2) return [absentNote(`A trade-off needs two runs with a trajectory error, and ${count} has one. The others`, errorPlace)];
  const left = runs.length - count;
  return [caption("Speed against accuracy: to the lower left is better. The line joins the runs that no other run on the same input beats in both. " +
                  (runs.some((run) => run.record.energy?.total) ? "Colour is energy." : "Energy is not shown: no run has it.")),
          chart("chart-trade-off", tradeOffChart, "Time against error of all runs with the Pareto front"),
          left ? absentNote("Not shown", errorPlace) : null];
}

const kinds = ["color", "depth", "track", "volume"];
const kindWords = {color: "colour", depth: "depth", track: "tracking", volume: "surface"};

function pictures() {
  const shown = detailed.filter((run) => run.pictures.length);
  if (data.limits.pictures_left_out) return [absent("The pictures are left out: they would make this file too large. Name fewer frames with --pictures.")];
  if (!shown.length) return [absent("No run saved pictures: slambench run --images N saves them.")];
  const blocks = shown.flatMap((run) => {
    const mine = [...new Set(run.pictures.map((p) => p.kind))].sort((a, b) => kinds.indexOf(a) - kinds.indexOf(b));
    const frames = [...new Set(run.pictures.map((p) => p.frame))];
    const images = mine.flatMap((kind) => frames.map((frame) => {
      const picture = run.pictures.find((p) => p.frame === frame && p.kind === kind);
      const words = `${kindWords[kind] ?? kind}, frame ${frame}`;
      return element("figure", {}, picture ? element("img", {src: `data:image/png;base64,${picture.png}`, alt: words, title: words}) : "–",
                     element("figcaption", {}, words));
    }));
    return [runs.length > 1 ? element("h3", {}, run.name) : null,
            element("div", {class: "pictures", style: {gridTemplateColumns: `repeat(${frames.length}, minmax(0, 1fr))`, maxWidth: `${frames.length * 270}px`}}, ...images)];
  });
  const without = detailed.filter((run) => !run.pictures.length).map((run) => run.name);
  return [caption("Tracking: grey pixels were used; black: no measurement; red: outside the model's view; green: no surface there; blue: too far; yellow: normals differ."),
          ...blocks, without.length ? absent(`Without pictures: ${without.join(", ")}.`) : null];
}

function parameters() {
  const all = facts();
  const differs = all.filter((row) => new Set(row.values).size > 1);
  const chosen = all.filter((row) => row.group.startsWith("parameter") && row.set.some((by) => by && by !== "default"));
  const absentRows = runs.flatMap((run) => Object.entries(run.record.absent).map(([place, why]) =>
    (runs.length > 1 ? [{class: "name", text: run.name}, element("code", {}, place), {class: "long", text: why}]
                     : [element("code", {}, place), {class: "long", text: why}])));
  const rest = [element("details", {}, element("summary", {}, `All ${all.length} parameters and facts`), factTable(all))];
  if (absentRows.length) {
    rest.push(element("details", {}, element("summary", {}, "What was not measured, and why"),
      table(runs.length > 1 ? ["Run", "Figure", "Reason"] : ["Figure", "Reason"], absentRows)));
  }
  return runs.length > 1
    ? [caption("What differs between the runs:"), factTable(differs), ...rest]
    : [caption("Parameters that are not at their default, and where the run was made:"),
       factTable([...chosen, ...all.filter((row) => row.group === "provenance")]), ...rest];
}

const sections = [
  ["overview", "Overview", overview],
  ["accuracy", "Accuracy", accuracy],
  ["stages", "Stages", stages],
  ["kernels", "Kernels", kernels],
  ["times", "Along the sequence", alongTheSequence],
  ["errors", "Error", error],
  ["path", "Path", path],
  ["trade-off", "Trade-off", tradeOff],
  ["energy", "Energy", energy],
  ["counters", "Counters", counters],
  ["pictures", "Pictures", pictures],
  ["parameters", "Parameters and provenance", parameters],
];

/** "36 runs of 12 configurations". */
function runCount() {
  const count = runs.reduce((sum, run) => sum + repeats(run), 0);
  return count > runs.length ? `${count} runs of ${runs.length} configurations` : `${count} runs`;
}

function build() {
  const first = runs[0].record;
  document.getElementById("subtitle").textContent = runs.length === 1
    ? [runs[0].name, describe(first), first.provenance.device ?? first.provenance.cpu, first.provenance.started_at].filter((part) => part).join(" · ")
    : `${runCount()} on ${[...new Set(runs.map((run) => run.record.provenance.device ?? run.record.provenance.cpu))].join("; ")}`;
  const main = document.getElementById("sections"), contents = element("ul");
  for (const [id, title, make] of sections) {
    const parts = make();
    if (!parts) continue;
    main.append(element("section", {id}, element("h2", {}, title), ...parts.filter((part) => part)));
    contents.append(element("li", {}, element("a", {href: `#${id}`}, title)));
  }
  document.getElementById("contents").append(contents);
  document.getElementById("footer").append(`Made by ${data.program}. Charts: plotly.js (MIT licence, Plotly, Inc.).`);
}

/** Puts the chart library, which is kept compressed, into the page. */
async function unpackLibrary() {
  const packed = document.getElementById("chart-library");
  const bytes = Uint8Array.from(atob(packed.textContent), (c) => c.charCodeAt(0));
  packed.remove();
  const unpacked = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  document.head.append(element("script", {}, await new Response(unpacked).text()));
}

function pageColors() {
  const style = getComputedStyle(document.documentElement);
  const color = (name) => style.getPropertyValue(`--${name}`).trim();
  return {page: color("page"), card: color("card"), ink: color("ink"), soft: color("soft"), line: color("line"),
          lost: document.documentElement.dataset.theme === "dark" ? "#ff8f6b" : "#b3261e"};
}

const drawing = {displaylogo: false, displayModeBar: matchMedia("(hover: hover)").matches ? "hover" : false,
  responsive: true, modeBarButtonsToRemove: ["select2d", "lasso2d", "autoScale2d"]};

async function draw() {
  const colors = pageColors();
  for (const {build: make, place} of charts) {
    const {data: traces, layout: look} = make(colors);
    await Plotly.react(place, traces, look, drawing);
  }
}

const prefersDark = matchMedia("(prefers-color-scheme: dark)");
function setTheme(dark) {
  document.documentElement.dataset.theme = dark ? "dark" : "light";
}

async function start() {
  const root = document.documentElement;
  setTheme(prefersDark.matches);
  try {
    build();
    await unpackLibrary();
    await draw();
    root.dataset.state = "ready";
  } catch (error) {
    root.dataset.state = "failed";
    document.getElementById("sections").prepend(element("p", {class: "notice"},
      `This page cannot be shown whole in this browser (${error.message}).`));
    console.error(error);
    return;
  }
  const change = (dark) => { setTheme(dark); draw(); };
  document.getElementById("theme").addEventListener("click", () => change(root.dataset.theme !== "dark"));
  prefersDark.addEventListener("change", (event) => change(event.matches));

  // Paper is white and narrower than the window.
  let before;
  addEventListener("beforeprint", () => {
    before = root.dataset.theme;
    setTheme(false);
    draw();
    for (const {place} of charts) Plotly.Plots.resize(place);
  });
  addEventListener("afterprint", () => change(before === "dark"));
}

start();
