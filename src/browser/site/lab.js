'use strict';

/// The lab: a scene, its numbers as sliders, integrators; what the program makes of them in an inner page. The state of
/// all controls is in the address.

const by = (id) => document.getElementById(id);
const file = 'scene.toml';
const place = new CommandPlace({
  starters: [by('run'), by('execute')], stop: by('stop'), bar: by('bar'), status: by('status'),
});
let page = '';

/// Numbers of a scene's text that sliders set: constants, masses and charges of bodies.
function numbersOf(text) {
  const numbers = [];
  // Bodies in one line: { name = "a", mass = 2, ... }
  for (const [line] of text.matchAll(/\{[^{}]*\}/g)) {
    const name = line.match(/\bname\s*=\s*"([^"]*)"/);
    if (!name || !/\bmass\s*=/.test(line)) continue;
    for (const [, key, quoted, bare] of line.matchAll(/\b(mass|charge)\s*=\s*(?:"([^"]*)"|([^,}\s]+))/g)) {
      const number = valueOf(quoted ?? bare);
      if (number) numbers.push({path: `${name[1]}.${key}`, number, about: ''});
    }
  }
  let table = '', name = '';
  for (const line of text.split('\n')) {
    const head = line.match(/^\s*\[{1,2}\s*([\w.]+)\s*\]{1,2}/);
    if (head) [table, name] = [head[1], ''];
    const entry = line.match(/^\s*([\w-]+)\s*=\s*(?:"([^"]*)"|([^#]*))(?:#\s*(.*))?/);
    if (!entry || head) continue;
    const [, key, quoted, bare, comment] = entry;
    const value = (quoted ?? bare).trim();
    if (key === 'name') name = value;
    const number = valueOf(value);
    if (number === null || number === 0) continue;
    if (table === 'constants') numbers.push({path: key, number, about: comment ?? ''});
    if ((table === 'body' || table === 'rigid_body') && name && (key === 'mass' || key === 'charge'))
      numbers.push({path: `${name}.${key}`, number, about: ''});
  }
  return numbers;
}

/// A decimal or a fraction of decimals; null of another expression.
function valueOf(text) {
  const parts = text.match(/^([-+]?[\d.]+(?:[eE][-+]?\d+)?)(?:\/([\d.]+))?$/);
  if (!parts) return null;
  const value = Number(parts[1]) / Number(parts[2] ?? 1);
  return Number.isFinite(value) ? value : null;
}

function showSliders(set = {}) {
  const box = by('sliders');
  box.replaceChildren();
  for (const {path, number, about} of numbersOf(by('text').value).slice(0, 8)) {
    const row = document.createElement('label');
    row.className = 'slider';
    row.title = about;
    const name = document.createElement('span');
    name.textContent = path;
    const slider = document.createElement('input');
    Object.assign(slider, {type: 'range', min: -2, max: 2, step: 0.05});
    slider.dataset.path = path;
    slider.dataset.number = number;
    slider.value = path in set ? Math.log2(Number(set[path]) / number) : 0;
    const value = document.createElement('output');
    const tell = () => { value.textContent = valueAt(slider); };
    slider.addEventListener('input', tell);
    tell();
    row.append(name, slider, value);
    box.append(row);
  }
}

const valueAt = (slider) => String(Number((slider.dataset.number * 2 ** slider.value).toPrecision(4)));

/// What sliders change: {path: value}.
function changes() {
  const set = {};
  for (const slider of by('sliders').querySelectorAll('input'))
    if (Number(slider.value) !== 0) set[slider.dataset.path] = valueAt(slider);
  return set;
}

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
    scene: name, ...(text === hbvmScenes[name] ? {} : {text}), set: changes(), methods: methods(),
    step: by('step').value.trim(), until: by('until').value.trim(), precision: by('precision').value,
    reference: by('reference').checked,
  };
}

function restore(chosen) {
  by('scene').value = chosen.scene in hbvmScenes ? chosen.scene : 'double_pendulum';
  by('text').value = chosen.text ?? hbvmScenes[by('scene').value];
  showSliders(chosen.set ?? {});
  by('methods').replaceChildren();
  for (const name of chosen.methods ?? ['rk4', 'hbvm:auto,3']) addMethod(String(name));
  by('step').value = chosen.step ?? '1/16';
  by('until').value = chosen.until ?? '10';
  by('precision').value = chosen.precision ?? 'double';
  by('reference').checked = Boolean(chosen.reference);
  tellScene();
}

function remember() {
  const words = commandWords();
  history.replaceState(null, '', labHash(state()));
  by('command').textContent = 'hbvm ' + words.map(inShell).join(' ');
}

/// Those that hold for every integrator.
function settingWords({set, step, until, precision}) {
  return [...Object.entries(set).flatMap(([path, value]) => ['--set', `${path}=${value}`]),
    ...(step ? ['--step', step] : []), '--until', until, '--precision', precision];
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
  by('flaw').textContent = '';
}

/// Runs a command, which finds the scene as it is edited.
const command = (words, wanted = []) => place.run(words, {files: {[file]: by('text').value}, wanted});

async function run() {
  remember();
  const words = commandWords(file);
  const result = await command([...words, '--plot', 'page.html', '--json'], ['page.html']);
  by('flaw').textContent = '';
  page = result.files['page.html'] ?? '';
  by('save-page').disabled = !page;
  if (!page) {
    place.tell(complaintOf(result));
    if (/scene\.toml/.test(result.err)) by('flaw').textContent = complaintOf(result);
    return;
  }
  by('page').srcdoc = page;
  by('table').replaceChildren(tableOfRuns(runsOf(JSON.parse(result.out))));
  place.tell('Done.');
}

function save(name, text, kind) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([text], {type: kind}));
  link.download = name;
  link.click();
  URL.revokeObjectURL(link.href);
}

for (const name of Object.keys(hbvmScenes)) by('scene').append(new Option(name.replaceAll('_', ' '), name));
for (const name of hbvmMethods) by('known').append(new Option(name));

by('scene').addEventListener('change', () => {
  by('text').value = hbvmScenes[by('scene').value];
  showSliders();
  tellScene();
});
by('text').addEventListener('change', () => {
  showSliders(changes());
  tellScene();
});
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

restore(stateOfHash(location.hash));
if (location.hash.length > 1) window.addEventListener('load', run);
else remember();
