'use strict';

/// Commands on a page: their words, and what shows that one runs.

/// Words as a shell would part them.
function parted(line) {
  return [...line.matchAll(/'([^']*)'|"([^"]*)"|(\S+)/g)].map((found) => found[1] ?? found[2] ?? found[3]);
}

/// A word as a shell reads it back.
const inShell = (word) => (/^[\w.,:/=+-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`);

/// What an unsuccessful command says, without the program's name.
const complaintOf = (result) => result.err.replaceAll('hbvm: ', '');

/// A place where commands run, one at a time. `starters` are the buttons that start one, and `stop` ends it.
/// `bar` and `status` tell how far it is.
class CommandPlace {
  constructor({starters, stop, bar, status}) {
    Object.assign(this, {starters, stop, bar, status, engine: new Engine()});
    stop.addEventListener('click', () => this.engine.stop());
  }

  tell(text) {
    this.status.textContent = text;
  }

  async run(words, {files = {}, wanted = []} = {}) {
    this.busy(true);
    this.tell('Computing …');
    const result = await this.engine.run(words, {files, wanted, progress: (line) => this.progress(line)});
    this.busy(false);
    this.tell('');
    return result;
  }

  busy(is) {
    for (const button of this.starters) button.disabled = is;
    this.stop.disabled = !is;
    this.bar.hidden = !is;
    this.bar.removeAttribute('value');
  }

  progress(line) {
    const parts = line.match(/(\d+) of (\d+)/);
    if (parts) this.bar.value = Number(parts[1]) / Number(parts[2]);
    this.tell(line.replace(/\[[#.]*\]\s*/, ''));
  }
}
