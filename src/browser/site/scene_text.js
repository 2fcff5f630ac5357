'use strict';

/// A decimal or a fraction of decimals; null of another expression.
function valueOf(text) {
  const parts = text.match(/^([-+]?[\d.]+(?:[eE][-+]?\d+)?)(?:\/([\d.]+))?$/);
  if (!parts) return null;
  const value = Number(parts[1]) / Number(parts[2] ?? 1);
  return Number.isFinite(value) ? value : null;
}

/// The text of a scene, and where its numbers stand in it.
/// They are named as the program names them: a constant L, a.mass, a.charge, a.x, a.vx.
class SceneText {
  constructor(text) {
    this.text = text;
    this.tables = [];
    for (const {0: all, index} of text.matchAll(/\{[^{}]*\}/g))
      if (/\bmass\s*=/.test(all)) this.add('body', index, index + all.length);
    const heads = [...text.matchAll(/^[ \t]*\[{1,2}\s*([\w.]+)\s*\]{1,2}/gm)];
    heads.forEach(({0: all, 1: kind, index}, i) =>
      this.add(kind, index + all.length, heads[i + 1]?.index ?? text.length));
  }

  add(kind, begin, end) {
    const name = this.text.slice(begin, end).match(/\bname\s*=\s*["']([^"']*)["']/);
    this.tables.push({kind, begin, end, name: name ? name[1] : ''});
  }

  /// Where the value of a key stands in a table, {begin, end}; null if it is not there.
  entry({begin, end}, key) {
    const found = new RegExp(`(?:[{,]|^)[ \\t]*${key}\\s*=\\s*("[^"]*"|'[^']*'|\\[[^\\]]*\\]|[^,}\\]\\n#]+)`, 'm')
      .exec(this.text.slice(begin, end));
    if (!found) return null;
    const last = begin + found.index + found[0].trimEnd().length;
    return {begin: last - found[1].trimEnd().length, end: last};
  }

  /// The number at a place; null of what is none.
  numberAt(place) {
    return place && valueOf(this.text.slice(place.begin, place.end).replace(/^["']|["']$/g, ''));
  }

  /// Constants, masses and charges, without those that are 0: {path, number, about}.
  numbers() {
    const numbers = [];
    const note = (path, place, about = '') => {
      const number = this.numberAt(place);
      if (number) numbers.push({path, number, about});
    };
    for (const table of this.tables.filter(({kind}) => kind === 'constants')) {
      const text = this.text.slice(table.begin, table.end);
      for (const [, key, about] of text.matchAll(/^\s*([\w-]+)\s*=[^#\n]*(?:#\s*(.*))?/gm))
        note(key, this.entry(table, key), about);
    }
    for (const table of this.tables.filter(({kind, name}) => name && (kind === 'body' || kind === 'rigid_body')))
      for (const key of ['mass', 'charge']) note(`${table.name}.${key}`, this.entry(table, key));
    return numbers;
  }

  /// Where a number stands; null if its place is not found.
  placeOf(path) {
    const dot = path.lastIndexOf('.'), name = path.slice(0, Math.max(dot, 0)), key = path.slice(dot + 1);
    const table = this.tables.find(({kind, name: its}) =>
      dot < 0 ? kind === 'constants' : its === name && (kind === 'body' || kind === 'rigid_body'));
    if (!table) return null;
    if (dot < 0 || key === 'mass' || key === 'charge') return this.entry(table, key);
    const array = this.entry(table, key.length === 1 ? 'position' : 'velocity');
    if (!array) return null;
    const items = [...this.text.slice(array.begin, array.end).matchAll(/"[^"]*"|'[^']*'|[^\s,[\]]+/g)];
    const item = items['xyz'.indexOf(key.at(-1))];
    return item ? {begin: array.begin + item.index, end: array.begin + item.index + item[0].length} : null;
  }

  /// The text with other numbers, {path: number}; null if one of them has no place.
  with(numbers) {
    const changes = Object.entries(numbers).map(([path, number]) => ({...this.placeOf(path), number}));
    if (changes.some(({begin}) => begin === undefined)) return null;
    let text = this.text;
    for (const {begin, end, number} of changes.sort((a, b) => b.begin - a.begin))
      text = text.slice(0, begin) + number + text.slice(end);
    return text;
  }
}
