// The charts, as data and layout for plotly.js. Each takes the colours of the page and returns
// {data, layout}; nothing is drawn here.

// Okabe and Ito's colours, which people with any colour vision tell apart.
const okabeIto = ["#1F83C6", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#8C6BB1", "#7A7A7A"];
const runColor = (i) => okabeIto[i % okabeIto.length];
const stageColors = {
  acquire: "#B4BAC4", preprocess: "#56B4E9", track: "#E69F00", integrate: "#009E73",
  raycast: "#1F83C6", render: "#8A93A1",
};
const computation = ["preprocess", "track", "integrate", "raycast"];
const dashes = ["solid", "dash", "dot", "dashdot", "longdash"];

/** Text that plotly.js shows as it is: it takes some HTML for markup. */
const plain = (words) => String(words).replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/>/g, "&gt;");
const label = (name) => plain(name.length > 34 ? `${name.slice(0, 16)}…${name.slice(-17)}` : name);

function axis(colors, title, more = {}) {
  return {title: {text: title, font: {size: 12.5, color: colors.soft}, standoff: 8}, automargin: true,
          gridcolor: colors.line, linecolor: colors.line, zerolinecolor: colors.line,
          tickfont: {color: colors.soft}, ...more};
}

/** Room for a legend, or none. */
const topMargin = (legend) => ({l: 60, r: 24, t: legend ? 34 : 6, b: 48});

function layout(colors, more) {
  return {
    paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "rgba(0,0,0,0)",
    font: {family: "system-ui, -apple-system, Segoe UI, Inter, Roboto, Noto Sans, DejaVu Sans, sans-serif",
           size: 12.5, color: colors.ink},
    margin: topMargin(true), hovermode: "closest",
    hoverlabel: {bgcolor: colors.card, bordercolor: colors.line, font: {color: colors.ink}, namelength: -1},
    legend: {orientation: "h", traceorder: "normal", x: 0, y: 1.02, xanchor: "left", yanchor: "bottom", font: {color: colors.ink}},
    ...more,
  };
}

/** A category axis with the names of runs, the first on top. */
function runAxis(colors, shown) {
  return axis(colors, "", {tickvals: shown.map((_, i) => i), ticktext: shown.map((run) => label(nameOf(run))),
                           range: [shown.length - 0.4, -0.6], showgrid: false, zeroline: false,
                           tickfont: {color: colors.ink}});
}

/** In panels, which are narrow, a legend has more lines. */
const barHeight = (rows, each = 34) => (sequences.length > 1 ? 152 : 118) + each * rows;

/** Stage times as bars on top of each other; the frame rate at their end. */
function stageChart(colors, among) {
  const shown = among.filter((run) => run.record.time.stages);
  const total = (run) => run.record.time.computation_s.mean * 1e3;
  const traces = computation.map((stage) => ({
    type: "bar", orientation: "h", name: stage, y: shown.map((_, i) => i),
    x: shown.map((run) => (run.record.time.stages[stage]?.seconds_per_frame ?? 0) * 1e3),
    marker: {color: stageColors[stage], line: {color: colors.page, width: 1}},
    customdata: shown.map((run) => {
      const s = run.record.time.stages[stage];
      return [plain(run.name), s ? percent(s.share_of_computation) : "", s?.seconds ? `${text(s.seconds.p95 * 1e3)} ms` : "–"];
    }),
    hovertemplate: `<b>${stage}</b>, %{customdata[0]}<br>%{x:.3f} ms a frame, %{customdata[1]}<br>where it ran, 95 % within %{customdata[2]}<extra></extra>`,
  }));
  const betweenStages = (run) => run.record.time.between_stages?.seconds_per_frame ?? 0;
  if (shown.some(betweenStages)) {
    traces.push({type: "bar", orientation: "h", name: "between_stages", y: shown.map((_, i) => i),
      x: shown.map((run) => betweenStages(run) * 1e3), marker: {color: colors.line, line: {color: colors.page, width: 1}},
      hovertemplate: "launching and waiting<br>%{x:.3f} ms a frame<extra></extra>"});
  }
  const ranges = shown.map((run) => interval(run.record, "time.computation_s.mean", 1e3));
  const ends = shown.map((run, i) => Math.max(total(run), ranges[i]?.high ?? 0));
  const longest = Math.max(...ends);
  const repeated = shown.map((_, i) => i).filter((i) => ranges[i]);
  if (repeated.length) {
    traces.push({type: "scatter", mode: "markers", name: "95 % interval",
      x: repeated.map((i) => total(shown[i])), y: repeated, marker: {color: colors.ink, size: 1},
      error_x: {type: "data", symmetric: false, color: colors.ink, thickness: 1.5, width: 5,
                array: repeated.map((i) => ranges[i].high - total(shown[i])),
                arrayminus: repeated.map((i) => total(shown[i]) - ranges[i].low)},
      hovertemplate: "%{x:.3f} ms of computation a frame<extra></extra>"});
  }
  const annotations = shown.map((run, i) => ({
    x: ends[i], y: i, xanchor: "left", xshift: 8, showarrow: false, font: {color: colors.ink, size: 13},
    text: `<b>${text(run.record.time.fps_computation)}</b> FPS`}));
  return {data: traces, layout: layout(colors, {
    barmode: "stack", bargap: 0.32, height: barHeight(shown.length, 42), annotations,
    xaxis: axis(colors, "mean time of a frame, ms", {range: [0, longest * (sequences.length > 1 ? 1.4 : 1.25)]}), yaxis: runAxis(colors, shown)})};
}

/** Kernels of all shown runs in the order of the pipeline, with their stages. */
function kernelsOf(shown) {
  const stages = new Map();
  for (const run of shown) {
    for (const [name, kernel] of Object.entries(run.record.time.kernels)) {
      if (computation.includes(kernel.stage)) stages.set(name, kernel.stage);
    }
  }
  return [...stages].sort(([, a], [, b]) => computation.indexOf(a) - computation.indexOf(b));
}
const kernelNames = (shown) => kernelsOf(shown).map(([name]) => name);

/** The colour with so much white in it, 0 to 1. */
function lighter(color, white) {
  const part = (at) => Math.round(parseInt(color.slice(at, at + 2), 16) * (1 - white) + 255 * white);
  return `rgb(${part(1)},${part(3)},${part(5)})`;
}

/** Several runs: shares of kernels as bars of the same length; kernels of a stage have shades of its colour. */
function kernelShares(colors, among) {
  const shown = among.filter((run) => run.record.time.kernels);
  const kernels = kernelsOf(shown);
  const traces = kernels.map(([name, stage], k) => {
    const siblings = kernels.filter(([, other]) => other === stage);
    const nth = siblings.findIndex(([other]) => other === name);
    const of = (run) => run.record.time.kernels[name];
    return {type: "bar", orientation: "h", name, y: shown.map((_, i) => i),
      x: shown.map((run) => (of(run)?.share_of_computation ?? 0) * 100),
      marker: {color: lighter(stageColors[stage], (1 - (nth + 1) / siblings.length) * 0.7), line: {color: colors.page, width: 1}},
      customdata: shown.map((run) => [plain(run.name), of(run) ? `${text(of(run).seconds_per_frame * 1e3)} ms a frame` : "not called"]),
      hovertemplate: `<b>${name}</b> (${stage}), %{customdata[0]}<br>%{x:.2f} % of computation, %{customdata[1]}<extra></extra>`};
  });
  const rest = shown.map((run) => 100 * (1 - kernels.reduce((sum, [name]) => sum + (run.record.time.kernels[name]?.share_of_computation ?? 0), 0)));
  if (rest.some((share) => share > 1)) {
    traces.push({type: "bar", orientation: "h", name: "in no kernel", y: shown.map((_, i) => i), x: rest.map((share) => Math.max(share, 0)),
      marker: {color: stageColors.acquire, line: {color: colors.page, width: 1}}, customdata: shown.map((run) => plain(run.name)),
      hovertemplate: "in no kernel, %{customdata}<br>%{x:.2f} % of computation<extra></extra>"});
  }
  return {data: traces, layout: layout(colors, {barmode: "stack", bargap: 0.3, height: barHeight(shown.length, 38) + 44,
    xaxis: axis(colors, "share of computation, %", {range: [0, 102]}), yaxis: runAxis(colors, shown)})};
}

/** Up to four runs: a bar for each kernel and run. */
function kernelBars(colors, among) {
  const shown = among.filter((run) => run.record.time.kernels);
  const names = kernelNames(shown);
  const traces = shown.map((run, r) => {
    const kernels = names.map((name) => run.record.time.kernels[name]);
    return {
      type: "bar", orientation: "h", name: label(nameOf(run)), y: names, x: kernels.map((k) => (k ? k.seconds_per_frame * 1e3 : null)),
      marker: {color: shown.length === 1 ? kernels.map((k) => stageColors[k.stage]) : colorOf(run)},
      text: kernels.map((k) => (k?.share_of_computation === undefined ? "" : percent(k.share_of_computation))),
      textposition: "outside", cliponaxis: false, textfont: {color: colors.soft, size: 11},
      customdata: kernels.map((k) => (k ? [k.stage, text(k.calls_per_frame), text(k.seconds_per_call * 1e3)] : ["", "", ""])),
      hovertemplate: `<b>%{y}</b> (%{customdata[0]}), ${plain(run.name)}<br>%{x:.3f} ms a frame, %{text} of computation<br>%{customdata[1]} calls a frame of %{customdata[2]} ms<extra></extra>`,
    };
  });
  return {data: traces, layout: layout(colors, {
    barmode: "group", bargap: 0.25, showlegend: shown.length > 1, margin: topMargin(shown.length > 1),
    height: barHeight(names.length, 14 + 12 * shown.length),
    xaxis: axis(colors, "mean time of a frame, ms", {rangemode: "tozero"}),
    yaxis: axis(colors, "", {autorange: "reversed", showgrid: false, tickfont: {color: colors.ink}})})};
}

/** More runs: a table of shares with colours. */
function kernelMap(colors, among) {
  const shown = among.filter((run) => run.record.time.kernels);
  const names = kernelNames(shown);
  const share = (run, name) => {
    const s = run.record.time.kernels[name]?.share_of_computation;
    return s === undefined ? null : s * 100;
  };
  const z = shown.map((run) => names.map((name) => share(run, name)));
  const most = Math.max(...z.flat());
  const annotations = z.flatMap((row, y) => row.map((value, x) => ({
    x, y, showarrow: false, text: value === null ? "–" : value < 10 ? value.toFixed(1) : value.toFixed(0),
    font: {size: 11, color: value === null ? colors.soft : value > most * 0.5 ? "#111111" : "#ffffff"}})));
  return {data: [{
    type: "heatmap", z, x: names.map((_, i) => i), y: shown.map((_, i) => i), colorscale: "Cividis", xgap: 2, ygap: 2, zmin: 0,
    colorbar: {title: {text: "% of<br>computation", font: {size: 12}}, thickness: 12, outlinewidth: 0, tickfont: {color: colors.soft}},
    customdata: shown.map((run) => names.map((name) => [plain(run.name), name])), hoverongaps: false,
    hovertemplate: "<b>%{customdata[1]}</b>, %{customdata[0]}<br>%{z:.2f} % of computation<extra></extra>"}],
    layout: layout(colors, {annotations, margin: topMargin(false), height: barHeight(shown.length, 30) + 60,
      xaxis: axis(colors, "", {tickvals: names.map((_, i) => i), ticktext: names, tickangle: -40, showgrid: false, tickfont: {color: colors.ink}}),
      yaxis: runAxis(colors, shown)})};
}

/** [[0, 3], [17, 17]] as a list of frames. */
const frameList = (spans) => (spans ?? []).flatMap(([first, last]) =>
  Array.from({length: last - first + 1}, (_, i) => first + i));

/** Lost frames at their time, dropped ones on the axis. */
function frameMarks(run, color, height) {
  const f = run.frames;
  const r = run.record.frames;
  const where = new Map(f.index.map((index, i) => [index, i]));
  const lost = frameList(r.lost_frames), dropped = frameList(r.dropped_frames);
  const name = detailed.length > 1 ? `, ${label(run.name)}` : "";
  const marks = (frames, y, word, symbol) => ({
    type: "scatter", mode: "markers", name: `${word}${name}`, x: frames, y,
    marker: {symbol, size: 9, color, line: {width: 1.6, color}},
    hovertemplate: `frame %{x} ${word}<extra>${plain(run.name)}</extra>`});
  return [
    ...(lost.length ? [marks(lost, lost.map((frame) => height(where.get(frame))), "lost", "x-thin")] : []),
    ...(dropped.length ? [marks(dropped, dropped.map(() => 0), "dropped", "line-ns")] : []),
  ];
}

/** The times of measured frames decide what is seen: in the first frame a device may compile for seconds. */
function timeRange() {
  const most = Math.max(0, ...detailed.map((run) => {
    const warmup = new Set(frameList(run.record.time.warmup_frames));
    return run.frames.computation_ms.reduce((top, ms, row) => (warmup.has(run.frames.index[row]) ? top : Math.max(top, ms ?? 0)), 0);
  }));
  return most > 0 ? {range: [0, most * 1.08]} : {rangemode: "tozero"};
}

/** One run: its stages on top of each other along the sequence; several: a line each. */
function timeChart(colors) {
  const traces = [];
  if (detailed.length === 1) {
    const f = detailed[0].frames;
    for (const stage of computation) {
      if (!f.stages_ms[stage]) continue;
      traces.push({type: "scatter", mode: "lines", stackgroup: "stages", name: stage, x: f.index,
        y: f.stages_ms[stage].map((ms) => ms ?? 0), line: {width: 0, color: stageColors[stage]}, fillcolor: stageColors[stage],
        hovertemplate: `frame %{x}, <b>${stage}</b> %{y:.3f} ms<extra></extra>`});
    }
    if (detailed[0].record.time.between_stages) {
      const inStages = (row) => computation.reduce((sum, stage) => sum + (f.stages_ms[stage]?.[row] ?? 0), 0);
      traces.push({type: "scatter", mode: "lines", stackgroup: "stages", name: "between_stages", x: f.index,
        y: f.computation_ms.map((ms, row) => Math.max(0, (ms ?? 0) - inStages(row))), line: {width: 0, color: colors.line}, fillcolor: colors.line,
        hovertemplate: "frame %{x}, launching and waiting %{y:.3f} ms<extra></extra>"});
    }
  } else {
    detailed.forEach((run) => traces.push({type: "scatter", mode: "lines", name: label(nameOf(run)), connectgaps: true,
      x: run.frames.index, y: run.frames.computation_ms, line: {width: 1.3, color: colorOf(run)},
      hovertemplate: `frame %{x}<br>%{y:.3f} ms of computation<extra>${plain(run.name)}</extra>`}));
  }
  detailed.forEach((run) => traces.push(...frameMarks(run, detailed.length === 1 ? colors.lost : colorOf(run),
    (row) => run.frames.computation_ms[row] ?? 0)));
  return {data: traces, layout: layout(colors, {height: 380,
    xaxis: axis(colors, "frame of the sequence", {zeroline: false}),
    yaxis: axis(colors, "computation of a frame, ms", timeRange())})};
}

/** The range of heights in a path chart: a flat path is not shown as thin as it is. */
function heightRange(shown) {
  const ends = (values) => [Math.min(...values), Math.max(...values)];
  const all = (key) => ends(shown.flatMap(({path}) => ends(path[key])));
  const [low, high] = all("up");
  const widest = Math.max(...["right", "forward"].map((key) => all(key)[1] - all(key)[0]));
  const half = Math.max((high - low) * 0.55, widest * 0.2);
  return [(low + high) / 2 - half, (low + high) / 2 + half];
}

const hasErrors = (run) => run.frames.error_se3_mm?.some((error) => error !== null);

function errorChart(colors) {
  const traces = [];
  const line = (run, values, name, color, dash) => traces.push({
    type: "scatter", mode: "lines", name, connectgaps: true, x: run.frames.index, y: values, line: {width: 1.6, color, dash},
    hovertemplate: `frame %{x}<br>%{y:.3f} mm<extra>${name}</extra>`});
  detailed.forEach((run) => {
    if (!hasErrors(run)) return;
    if (detailed.length > 1) {
      line(run, run.frames.error_se3_mm, label(nameOf(run)), colorOf(run));
    } else {
      line(run, run.frames.error_se3_mm, "after SE(3) alignment", okabeIto[0]);
      line(run, run.frames.error_first_pose_mm, "first poses made equal", okabeIto[1], "dot");
    }
  });
  return {data: traces, layout: layout(colors, {height: 340, showlegend: true,
    xaxis: axis(colors, "frame of the sequence", {zeroline: false}),
    yaxis: axis(colors, "distance to the true position, mm", {rangemode: "tozero"})})};
}

/** Estimated, then true paths as {name, path, color, dash, width}; one truth for equal sequences. */
function paths(colors) {
  const list = [], trueOnes = [];
  const truths = new Set();
  detailed.forEach((run) => {
    list.push({name: label(nameOf(run)), path: run.paths.estimate, color: colorOf(run), dash: "solid", width: 2.2});
    const sequence = run.record.sequence.name ?? "";
    if (!run.paths.truth || truths.has(sequence)) return;
    truths.add(sequence);
    const others = new Set(detailed.map((other) => other.record.sequence.name)).size > 1;
    trueOnes.push({name: others ? `truth, ${label(sequence)}` : "truth", path: run.paths.truth, color: colors.ink, dash: "dash", width: 1.6});
  });
  return [...list, ...trueOnes];
}

function pathChart(colors) {
  const scene = (title) => ({title: {text: title, font: {size: 12, color: colors.soft}}, gridcolor: colors.line, color: colors.soft,
                             zerolinecolor: colors.line, showbackground: false, nticks: 6});
  const traces = paths(colors).map((p) => ({
    type: "scatter3d", mode: "lines", name: p.name, x: p.path.right, y: p.path.forward, z: p.path.up,
    line: {color: p.color, width: p.dash === "solid" ? 5 : 3, dash: p.dash},
    hovertemplate: `right %{x:.3f} m<br>forward %{y:.3f} m<br>up %{z:.3f} m<extra>${p.name}</extra>`}));
  const first = detailed[0].paths.estimate;
  traces.push({type: "scatter3d", mode: "markers", name: "start", x: [first.right[0]], y: [first.forward[0]], z: [first.up[0]],
    marker: {color: colors.ink, size: 4}, hovertemplate: "start<extra></extra>"});
  return {data: traces, layout: layout(colors, {height: 470, margin: {l: 0, r: 0, t: 30, b: 0}, scene: {
    xaxis: scene("right, m"), yaxis: scene("forward, m"), zaxis: {...scene("up, m"), nticks: 4, range: heightRange(paths(colors))}, aspectmode: "data", dragmode: "orbit",
    camera: {eye: {x: -1.8, y: -2.3, z: 1.7}, center: {x: 0, y: 0, z: -0.2}}}})};
}

function pathFromAbove(colors) {
  const traces = paths(colors).map((p) => ({
    type: "scatter", mode: "lines", name: p.name, x: p.path.right, y: p.path.forward, line: {color: p.color, dash: p.dash, width: p.width},
    hovertemplate: `right %{x:.3f} m<br>forward %{y:.3f} m<extra>${p.name}</extra>`}));
  const first = detailed[0].paths.estimate;
  traces.push({type: "scatter", mode: "markers", name: "start", x: [first.right[0]], y: [first.forward[0]],
    marker: {color: colors.ink, size: 9}, hovertemplate: "start<extra></extra>"});
  return {data: traces, layout: layout(colors, {height: 470, showlegend: false,
    xaxis: axis(colors, "right, m", {zeroline: false}), yaxis: axis(colors, "forward, m", {scaleanchor: "x", zeroline: false})})};
}

/** Energy of a frame by rail; rails that hold others are beside them, not added to them. */
function energyChart(colors, among) {
  const shown = among.filter((run) => run.record.energy);
  const rails = [...new Set(shown.flatMap((run) => Object.keys(run.record.energy.rails)))];
  const rows = [...rails, "total"];
  const of = (run, row) => (row === "total" ? run.record.energy.total : run.record.energy.rails[row]);
  const traces = shown.map((run) => {
    const values = rows.map((row) => of(run, row));
    const ranges = rows.map((row) => interval(run.record,
      row === "total" ? "energy.total.joules_per_frame" : `energy.rails.${row}.joules_per_frame`));
    const distance = (side) => ranges.map((range, i) =>
      (range && values[i] ? Math.abs(range[side] - values[i].joules_per_frame) : null));
    return {type: "bar", orientation: "h", name: label(nameOf(run)), y: rows.map(plain), x: values.map((v) => v?.joules_per_frame ?? null),
      marker: {color: colorOf(run)},
      error_x: ranges.some((range) => range)
        ? {type: "data", symmetric: false, array: distance("high"), arrayminus: distance("low"), color: colors.ink, thickness: 1.4}
        : undefined,
      customdata: values.map((v) => (v ? [text(v.mean_w), v.within ? `, within ${plain(v.within)}` : ""] : ["", ""])),
      hovertemplate: `<b>%{y}</b>%{customdata[1]}<br>%{x:.4f} J a frame, %{customdata[0]} W on average<extra>${plain(run.name)}</extra>`};
  });
  return {data: traces, layout: layout(colors, {barmode: "group", bargap: 0.3, showlegend: shown.length > 1, margin: topMargin(shown.length > 1),
    height: barHeight(rows.length, 16 + 16 * shown.length),
    xaxis: axis(colors, "energy of a frame, J", {rangemode: "tozero"}),
    yaxis: axis(colors, "", {autorange: "reversed", showgrid: false, tickfont: {color: colors.ink}})})};
}

/** Rails that add up to the total, of any of the runs. */
const wholeRails = (shown) => [...new Set(shown.flatMap((run) =>
  Object.entries(run.record.energy?.rails ?? {}).filter(([, rail]) => rail.in_total).map(([name]) => name)))];

/** Several runs: the energy of a frame as bars of its rails on top of each other; sum and time at their end. */
function energyStack(colors, among) {
  const shown = among.filter((run) => run.record.energy?.total);
  const traces = wholeRails(shown).map((rail, k) => ({
    type: "bar", orientation: "h", name: plain(rail), y: shown.map((_, i) => i),
    x: shown.map((run) => run.record.energy.rails[rail]?.joules_per_frame ?? null),
    marker: {color: okabeIto[k % okabeIto.length], line: {color: colors.page, width: 1}},
    customdata: shown.map((run) => [plain(run.name), text(run.record.energy.rails[rail]?.mean_w ?? 0)]),
    hovertemplate: `<b>${plain(rail)}</b>, %{customdata[0]}<br>%{x:.4f} J a frame, %{customdata[1]} W on average<extra></extra>`}));
  const totals = shown.map((run) => run.record.energy.total.joules_per_frame);
  const ranges = shown.map((run) => interval(run.record, "energy.total.joules_per_frame"));
  const repeated = shown.map((_, i) => i).filter((i) => ranges[i]);
  if (repeated.length) {
    traces.push({type: "scatter", mode: "markers", name: "95 % interval", x: repeated.map((i) => totals[i]), y: repeated,
      marker: {color: colors.ink, size: 1}, hovertemplate: "%{x:.4f} J a frame<extra></extra>",
      error_x: {type: "data", symmetric: false, color: colors.ink, thickness: 1.5, width: 5,
                array: repeated.map((i) => ranges[i].high - totals[i]), arrayminus: repeated.map((i) => totals[i] - ranges[i].low)}});
  }
  const ends = shown.map((_, i) => Math.max(totals[i], ranges[i]?.high ?? 0));
  const annotations = shown.map((run, i) => ({
    x: ends[i], y: i, xanchor: "left", xshift: 8, showarrow: false, font: {color: colors.ink, size: 13},
    text: `<b>${text(totals[i])}</b> J` + (run.record.time.computation_s ? `, ${text(run.record.time.computation_s.mean * 1e3)} ms` : "")}));
  const room = sequences.length > 1 ? 1.75 : 1.3;
  return {data: traces, layout: layout(colors, {barmode: "stack", bargap: 0.32, height: barHeight(shown.length, 42), annotations, showlegend: true,
    xaxis: axis(colors, "energy of a frame, J", {range: [0, Math.max(...ends) * room]}), yaxis: runAxis(colors, shown)})};
}

/** Rails whose power the detailed runs have. */
const sampledRails = () => [...new Set(detailed.flatMap((run) => run.power.map((series) => series.rail)))];

/** Lines over the time of the run: of one run all rails, of several one rail; x and y by `values` of a series, means as steps. */
function overTime(colors, title, rail, steps, values) {
  const rails = sampledRails();
  const traces = detailed.flatMap((run) => run.power.filter((series) => !rail || series.rail === rail).map((series) => {
    const one = detailed.length === 1;
    const name = one ? plain(series.rail) : label(nameOf(run));
    return {type: "scatter", mode: "lines", name, ...values(series),
      line: {width: 1.5, color: one ? okabeIto[rails.indexOf(series.rail) % okabeIto.length] : colorOf(run), shape: series.mean && steps ? "vh" : "linear"},
      hovertemplate: `%{x:.2f} s<br><b>%{y:.3f}</b><extra>${name}</extra>`};
  }));
  return {data: traces, layout: layout(colors, {height: 340, showlegend: true,
    xaxis: axis(colors, "time since the first frame, s", {rangemode: "tozero"}), yaxis: axis(colors, title, {rangemode: "tozero"})})};
}

/** A mean holds since the reading before. */
const powerChart = (colors, rail) => overTime(colors, "power, W", rail, true, (series) => (series.mean
  ? {x: [0, ...series.time_s], y: [series.power_w[0], ...series.power_w]}
  : {x: series.time_s, y: series.power_w}));

/** The powers added up. */
const energySoFarChart = (colors, rail) => overTime(colors, "energy so far, J", rail, false, ({time_s: t, power_w: w, mean}) => {
  const sums = [0];
  for (let i = 0; i < t.length; ++i) {
    const step = t[i] - (i ? t[i - 1] : 0);
    sums.push(sums[i] + step * (mean || i === 0 ? w[i] : (w[i] + w[i - 1]) / 2));
  }
  return {x: [0, ...t], y: sums};
});

const errorPlace = atePlace;
const timePlace = "time.computation_s.mean";

/** Runs that can stand in the chart of speed against accuracy. */
const judged = () => runs.map((run, i) => ({run, i}))
  .filter(({run}) => at(run.record, errorPlace) !== undefined && at(run.record, timePlace) !== undefined);

/** Speed against accuracy; colour is energy where it was measured; a symbol and a front an input. */
function tradeOffChart(colors) {
  const points = judged();
  const inputOf = (i) => data.fronts.findIndex((front) => front.runs.includes(i));
  const symbols = ["circle", "square", "diamond", "triangle-up", "star", "cross"];
  const energy = points.map(({run}) => at(run.record, "energy.total.joules_per_frame") ?? null);
  const measured = energy.some((joules) => joules !== null);
  const x = ({run}) => run.record.time.computation_s.mean * 1e3;
  const y = ({run}) => at(run.record, errorPlace) * 1e3;
  const spread = (place, value) => {
    const ranges = points.map(({run}) => interval(run.record, place, 1e3));
    if (!ranges.some((range) => range)) return undefined;
    return {type: "data", symmetric: false, color: colors.soft, thickness: 1.2,
            array: ranges.map((range, k) => (range ? range.high - value(points[k]) : null)),
            arrayminus: ranges.map((range, k) => (range ? value(points[k]) - range.low : null))};
  };
  const traces = data.fronts.filter((front) => front.runs.length > 1).map((front, k) => {
    const ends = front.front.map((i) => ({run: runs[i]}));
    return {type: "scatter", mode: "lines", hoverinfo: "skip", line: {shape: "hv", color: colors.soft, width: 1.5, dash: dashes[(k + 1) % dashes.length]},
      name: data.fronts.length > 1 ? `Pareto front, ${plain(front.input)}` : "Pareto front",
      x: ends.map(x), y: ends.map(y)};
  });
  const few = points.length <= 14;
  traces.push({type: "scatter", mode: few ? "markers+text" : "markers", name: "runs", showlegend: false,
    x: points.map(x), y: points.map(y), error_x: spread(timePlace, x), error_y: spread(errorPlace, y),
    text: points.map(({run}) => label(run.name)), textposition: "top right", cliponaxis: false, textfont: {size: 11, color: colors.soft},
    marker: {size: 13, line: {width: 1.2, color: colors.page},
      symbol: points.map(({i}) => symbols[inputOf(i) % symbols.length]),
      color: measured ? energy.map((joules) => joules ?? -1) : points.map(({run}) => colorOf(run)),
      ...(measured ? {colorscale: "Cividis", showscale: true, cmin: 0, cmax: Math.max(...energy),
        colorbar: {title: {text: "J a frame"}, thickness: 12, outlinewidth: 0, tickfont: {color: colors.soft}}} : {})},
    customdata: points.map(({run}, k) => [plain(run.name), plain(describe(run.record)), energy[k] === null ? "energy not measured" : `${text(energy[k])} J a frame`]),
    hovertemplate: "<b>%{customdata[0]}</b><br>%{customdata[1]}<br>%{x:.3f} ms a frame<br>error %{y:.3f} mm<br>%{customdata[2]}<extra></extra>"});
  if (data.fronts.length > 1) {
    data.fronts.forEach((front, k) => traces.push({type: "scatter", mode: "markers", name: plain(front.input), x: [null], y: [null],
      marker: {size: 11, color: colors.soft, symbol: symbols[k % symbols.length]}}));
  }
  return {data: traces, layout: layout(colors, {height: 460, showlegend: true,
    xaxis: axis(colors, "computation of a frame, ms (left is faster)", {rangemode: "tozero"}),
    yaxis: axis(colors, "ATE RMSE after SE(3), mm (low is better)", {rangemode: "tozero"})})};
}
