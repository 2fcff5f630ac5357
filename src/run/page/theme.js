/** Colours as the page has them now, light or dark. */
class Theme {
  constructor(colours) {
    this.given = colours;
    this.dark = window.matchMedia('(prefers-color-scheme: dark)');
  }

  onChange(call) { this.dark.addEventListener('change', call); }

  /** One of the style sheet's. */
  get(name) { return getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim(); }

  /** Of curve or body i; on a dark ground a third of the way to white. */
  colour(i) {
    const colour = this.given[i % this.given.length];
    if (!this.dark.matches) return colour;
    const part = (at) => Math.round(parseInt(colour.slice(at, at + 2), 16) * 0.65 + 255 * 0.35);
    return `rgb(${part(1)}, ${part(3)}, ${part(5)})`;
  }

  /** So much of a colour on the ground. */
  mixed(colour, share) {
    const parts = (text) => (text.startsWith('#') ? [1, 3, 5].map((at) => parseInt(text.slice(at, at + 2), 16)) : text.match(/\d+/g).map(Number));
    const ground = parts(this.get('back'));
    return `rgb(${parts(colour).map((x, i) => Math.round(share * x + (1 - share) * ground[i])).join(', ')})`;
  }

  /** Curves of one colour differ in their dashes. */
  dash(i) { return [null, [8, 4], [2, 4], [12, 4, 2, 4]][Math.floor(i / this.given.length) % 4]; }
}
