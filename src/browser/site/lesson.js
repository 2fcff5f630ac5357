'use strict';

/// A lesson: a question before the text goes on, experiments that run in the page, exercises that the program judges.

const lesson = document.getElementById('lesson');
const lessonFiles = JSON.parse(lesson.dataset.files);
const memory = `hbvm lesson ${lesson.dataset.name}`;

/// What a form's fields hold: {name: value}.
const valuesOf = (form) => Object.fromEntries([...new FormData(form)].map(([name, value]) => [name, value.trim()]));

/// Where the commands of a form run.
const placeOf = (form) => new CommandPlace({
  starters: [form.querySelector('.run')], stop: form.querySelector('.stop'), bar: form.querySelector('.bar'),
  status: form.querySelector('.status'),
});

/// The question; the answer is kept as long as the window is open.
class Question {
  constructor(form) {
    this.form = form;
    form.addEventListener('submit', (event) => {
      event.preventDefault();
      const [answer] = Object.values(valuesOf(form));
      this.keep(answer);
      this.show(answer);
      form.querySelector('.says').focus();
    });
    const answer = this.kept();
    if (answer !== null) this.show(answer);
  }

  kept() {
    try {
      return sessionStorage.getItem(memory);
    } catch {
      return null;
    }
  }

  keep(answer) {
    try {
      sessionStorage.setItem(memory, answer);
    } catch {
      // A browser may keep nothing for a page; the answer is then gone with the page.
    }
  }

  show(answer) {
    for (const field of this.form.querySelectorAll('input')) {
      if (field.type !== 'radio') field.value = answer;
      field.checked = field.value === answer;
      field.disabled = true;
    }
    this.form.querySelector('button').hidden = true;
    this.form.querySelector('.given').textContent = `Your answer: ${answer}.`;
    document.getElementById('main').classList.add('answered');
    experiments[0]?.run();
  }
}

/// A command with choices, and what it gives: a page that moves, a chart, or text.
class Experiment {
  constructor(form) {
    this.form = form;
    this.place = placeOf(form);
    this.result = form.querySelector('.result');
    Object.assign(this, JSON.parse(form.dataset.experiment));
    form.addEventListener('change', () => this.showCommand());
    form.addEventListener('submit', (event) => {
      event.preventDefault();
      this.run();
    });
    form.querySelector('.copy').addEventListener('click', () => navigator.clipboard.writeText(this.line()));
    window.addEventListener('resize', () => this.found && showConvergence(this.found, this.result));
    this.showCommand();
  }

  /// The command with what is chosen.
  line() {
    const chosen = valuesOf(this.form);
    return this.command.replace(/\{(\w+)\}/g, (all, name) => chosen[name] ?? all);
  }

  words() {
    return parted(this.line()).slice(1);
  }

  showCommand() {
    this.form.querySelector('.command').textContent = this.line();
    const link = this.form.querySelector('.to-lab'), state = stateOfCommand(this.words(), lessonFiles);
    link.hidden = state === null;
    if (state) link.href = '../lab.html' + labHash(state);
  }

  async run() {
    const more = {page: ['--plot', 'page.html', '--json'], chart: ['--json'], text: []}[this.draw];
    const result = await this.place.run([...this.words(), ...more], {files: lessonFiles, wanted: ['page.html']});
    // Some commands end with 1 where what they judge does not hold, and say so.
    const failed = this.draw === 'page' ? !result.files['page.html'] : !result.out;
    this.found = null;
    if (failed) this.result.replaceChildren();
    else this[this.draw + 'Of'](result);
    this.place.tell(failed ? complaintOf(result) : 'Done.');
    this.form.classList.toggle('failed', failed);
  }

  pageOf({out, files}) {
    const frame = document.createElement('iframe');
    frame.title = 'The motion on a clock, with energy, constraints and errors';
    frame.srcdoc = files['page.html'];
    this.result.replaceChildren(tableOfRuns(runsOf(JSON.parse(out))), frame);
  }

  chartOf({out}) {
    this.found = JSON.parse(out);
    showConvergence(this.found, this.result);
  }

  textOf({out, err}) {
    const said = [out, err].filter(Boolean).join('\n');
    this.result.replaceChildren(Object.assign(document.createElement('pre'), {tabIndex: 0, textContent: said}));
  }
}

/// Text as TOML has it between quotation marks.
const inToml = (text) => JSON.stringify(text).replaceAll('\u007f', '\\u007F');

/// Blanks that the program judges by computing.
class Exercise {
  constructor(form) {
    this.form = form;
    this.place = placeOf(form);
    form.addEventListener('submit', (event) => {
      event.preventDefault();
      this.check();
    });
    // What is said holds for what was checked.
    form.addEventListener('input', () => this.say('', ''));
  }

  async check() {
    this.say('', '');
    const name = this.form.dataset.name;
    const lines = Object.entries(valuesOf(this.form)).map(([blank, value]) => `${blank} = ${inToml(value)}\n`);
    const answers = `[${name}]\n${lines.join('')}`;
    const words = ['lesson', 'check', lesson.dataset.name, 'answers.toml', '--json'];
    const result = await this.place.run(words, {files: {'answers.toml': answers}});
    if (!result.out) return this.say('', complaintOf(result));
    const {right, says} = JSON.parse(result.out).exercises.find((exercise) => exercise.name === name);
    this.say(right ? 'right' : 'wrong', right ? 'Right.' : `Not yet: ${says}`);
  }

  say(kind, text) {
    const verdict = this.form.querySelector('.verdict');
    verdict.className = `verdict ${kind}`;
    verdict.textContent = text;
  }
}

const experiments = [...lesson.querySelectorAll('.experiment')].map((form) => new Experiment(form));
for (const form of lesson.querySelectorAll('.exercise')) new Exercise(form);
for (const form of lesson.querySelectorAll('.question')) new Question(form);

// The worksheet is what is printed with its class: what comes before the question, the question and the exercises.
document.getElementById('worksheet').addEventListener('click', () => {
  document.body.classList.add('worksheet');
  window.print();
});
window.addEventListener('afterprint', () => document.body.classList.remove('worksheet'));
