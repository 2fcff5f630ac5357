'use strict';

/// The lab: a scene, its start as a sketch, its numbers as sliders, integrators; what the program makes of them in an
/// inner page and in charts. The state of all controls is in the address.

const by = (id) => document.getElementById(id);
const place = new CommandPlace({
  starters: [by('run'), by('execute')], stop: by('stop'), bar: by('bar'), status: by('status'),
});
const sliders = new Sliders(by('sliders')), sketch = new Sketch(by('sketch'), (start) => inTurn(() => move(start)));
const portrait = new Portrait(by('portrait'), by('portrait-box')), soFar = new WorkPrecision(by('work-precision'));
let page = '';
let start = null;  // a Motion that begins with the start, if that is known

function addMethod(name) {
  const row = document.createElement('div');
  row.className = 'method';
  const input = document.createElement('input');
  Object.assign(input, {value: name, ariaLabel: 'Integrator', required: true});
  input.setAttribute('list', 'known');
  const remove = document.createElement('button');
  Object.assign(remove, {type: 'button', textContent: 'Remove'});
  remove.addEventListener('click', () => {
    if (by('methods').children.length > 1) row.remove();
    remember();
  });
  row.append(input, remove);
  by('methods').append(row);
}

const methods = () => [...by('methods').querySelectorAll('input')].map((input) => input.value.trim()).filter(Boolean);

/// Everything chosen, as short as can be: a shipped scene by its name, a changed one by its text.
function state() {
  const name = by('scene').value, text = by('text').value;
  return {
    scene: name, ...(text === hbvmScenes[name] ? {} : {text}), set: sliders.changes(), methods: methods(),
    step: by('step').value.trim(), until: by('until').value.trim(), precision: by('precision').value,
    reference: by('reference').checked, ...(portrait.chosen ? {portrait: portrait.chosen} : {}),
  };
}

function restore(chosen) {
  by('scene').value = chosen.scene in hbvmScenes ? chosen.scene : 'double_pendulum';
  by('text').value = chosen.text ?? hbvmScenes[by('scene').value];
  showSliders(chosen.set ?? {});
  // Its room, until the program has told of it.
  by('sketch').hidden = !/^\s*dimension\s*=\s*2/m.test(by('text').value);
  inTurn(look);
  by('methods').replaceChildren();
  for (const name of chosen.methods ?? ['rk4', 'hbvm:auto,3']) addMethod(String(name));
  by('step').value = chosen.step ?? '1/16';
  by('until').value = chosen.until ?? '10';
  by('precision').value = chosen.precision ?? 'double';
  by('reference').checked = Boolean(chosen.reference);
  portrait.chosen = chosen.portrait ?? '';
  tellScene();
}

function remember() {
  const words = commandWords();
  history.replaceState(null, '', labHash(state()));
  by('command').textContent = 'hbvm ' + words.map(inShell).join(' ');
}

const setWords = (set) => Object.entries(set).flatMap(([path, value]) => ['--set', `${path}=${value}`]);

/// Those that hold for every integrator.
function settingWords({set, step, until, precision}) {
  return [...setWords(set), ...(step ? ['--step', step] : []), '--until', until, '--precision', precision];
}

/// The words of the command, for the shell with the shipped scene's name, for the engine with the file's.
function commandWords(scene = null) {
  const chosen = state(), own = 'text' in chosen;
  const several = chosen.methods.length > 1;
  const words = [several ? 'compare' : 'run', scene ?? (own ? file : chosen.scene), several ? '--methods' : '--method',
    ...chosen.methods, ...settingWords(chosen)];
  if (chosen.reference) words.push(several ? '--reference' : '--error');
  return words;
}

function tellScene() {
  const title = by('text').value.match(/^\s*title\s*=\s*"(.*)"/m);
  by('about').textContent = title ? title[1] : '';
}

/// What is wrong with the scene; one whose start is, can be moved.
function tellFlaw(complaint) {
  by('flaw').textContent = complaint;
  by('project').hidden = !complaint.includes('scene project');
}

function showSliders(set) {
  const scene = new SceneText(by('text').value);
  sliders.show(scene.numbers(), set, start ? startsOf(start).filter(({path}) => scene.placeOf(path)) : []);
}

/// Jobs on the start, one after another.
let settled = Promise.resolve();
const starter = new Engine();
const inTurn = (job) => (settled = settled.then(job).catch((error) => tellFlaw(error.message)));

/// Shows the start of the scene as it is chosen.
async function look() {
  const found = await startOf(starter, by('text').value, setWords(sliders.changes()));
  start = found.motion;
  tellFlaw(found.complaint);
  sketch.show(start);
  showSliders(sliders.changes());
}

/// Another start, {path: number}, of which the numbers in `held` stay as they are.
async function move(numbers, held = []) {
  const found = await projected(starter, by('text').value, {...sliders.changes(), ...numbers}, held);
  if (found.complaint) return refuse(found.complaint);
  by('text').value = found.text;
  showSliders({});
  remember();
  await look();
}

/// What was moved goes back.
function refuse(complaint) {
  tellFlaw(complaint);
  sketch.show(start);
  showSliders(sliders.changes());
}

/// Runs a command, which finds the scene as it is edited.
const command = (words, wanted = []) => place.run(words, {files: {[file]: by('text').value}, wanted});

async function run() {
  place.busy(true);
  await settled;
  remember();
  const words = commandWords(file);
  const result = await command([...words, '--plot', 'page.html', '--json'], ['page.html']);
  page = result.files['page.html'] ?? '';
  for (const name of ['save-page', 'save-picture', 'save-film']) by(name).disabled = !page;
  if (!page) {
    const flawed = result.err.includes(file);
    if (flawed) tellFlaw(complaintOf(result));
    place.tell(flawed ? 'The scene is refused, as told below it.' : complaintOf(result));
    return;
  }
  tellFlaw('');
  by('page').srcdoc = page;
  const runs = runsOf(JSON.parse(result.out)), {text, scene, set, step, until, precision} = state();
  by('table').replaceChildren(tableOfRuns(runs));
  soFar.add(JSON.stringify([text ?? scene, set, until]), runs, `step ${step || 'of its own'}, ${precision}`);
  by('portrait-part').hidden = false;
  portrait.show(new Motion(dataOf(page)), runs.map((run) => run.resolved ?? run.method));
  place.tell('Done.');
}

function save(name, text, kind) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(text instanceof Blob ? text : new Blob([text], {type: kind}));
  link.download = name;
  link.click();
  URL.revokeObjectURL(link.href);
}

for (const name of Object.keys(hbvmScenes)) by('scene').append(new Option(name.replaceAll('_', ' '), name));
for (const name of hbvmMethods) by('known').append(new Option(name));

/// Another text: what is known of the one before is forgotten.
function edited(set) {
  start = null;
  sliders.forget();
  showSliders(set);
  tellScene();
  inTurn(look);
}

by('scene').addEventListener('change', () => {
  by('text').value = hbvmScenes[by('scene').value];
  edited({});
});
by('text').addEventListener('change', () => edited(sliders.changes()));
by('sliders').addEventListener('change', ({target}) => {
  const {path, start: ofStart} = target.dataset;
  inTurn(ofStart ? () => move({[path]: Number(sliders.valueAt(target))}, [path]) : look);
});
by('project').addEventListener('click', () => inTurn(() => move({})));
by('portrait').addEventListener('change', remember);
by('add').addEventListener('click', () => {
  addMethod('hbvm:4,2');
  remember();
});
// After what the controls themselves do on a change.
by('controls').addEventListener('change', remember);
by('controls').addEventListener('submit', (event) => {
  event.preventDefault();
  run();
});
by('link').addEventListener('click', () => navigator.clipboard.writeText(location.href));
by('save-page').addEventListener('click', () => save(`${by('scene').value}.html`, page, 'text/html'));
by('save-picture').addEventListener('click', () => {
  const charts = [...chartsOfPage(dataOf(page), 760), ...document.querySelectorAll('#results .chart')];
  save(`${by('scene').value}.svg`, pictureFile(charts), 'image/svg+xml');
});
by('save-film').addEventListener('click', async () => {
  by('save-film').disabled = true;
  place.tell('Recording one play of the motion …');
  const film = await filmOf(by('page').contentDocument);
  by('save-film').disabled = false;
  place.tell(film ? 'Done.' : 'This browser records no video.');
  if (film) save(`${by('scene').value}.${film.type.split('/')[1]}`, film);
});
by('save-scene').addEventListener('click', () => save(`${by('scene').value}.toml`, by('text').value, 'text/plain'));
by('save-csv').addEventListener('click', async () => {
  const chosen = state();
  const words = ['run', file, '--method', chosen.methods[0], ...settingWords(chosen), '--out', 'motion.csv'];
  const result = await command(words, ['motion.csv']);
  if (result.files['motion.csv']) save(`${chosen.scene}.csv`, result.files['motion.csv'], 'text/csv');
  else place.tell(complaintOf(result));
});
by('execute').addEventListener('click', async () => {
  const words = parted(by('words').value);
  if (words[0] === 'hbvm') words.shift();
  const result = await command(words);
  by('output').textContent = [result.out, result.err].filter(Boolean).join('\n');
});

let width = window.innerWidth;
window.addEventListener('resize', () => {
  // A phone's bars come and go with another height alone.
  if (window.innerWidth === width) return;
  width = window.innerWidth;
  sketch.show(start);
  soFar.draw();
  portrait.draw();
});

restore(stateOfHash(location.hash));
if (location.hash.length > 1) window.addEventListener('load', run);
else remember();
