'use strict';

/** Numbers as text, as printed in a book: −1.25·10⁻⁷. */
const Numbers = {
  /** "10^{-16}", as the tics of an axis have it. */
  raised(text) {
    const digits = '⁰¹²³⁴⁵⁶⁷⁸⁹';
    return Numbers.signed(
      text.replace(/\^\{([^}]*)\}/g, (_, power) => power.replace(/-/g, '⁻').replace(/\d/g, (d) => digits[d])));
  },

  /** λ₁₂ */
  lowered: (text) => text.replace(/\d/g, (d) => '₀₁₂₃₄₅₆₇₈₉'[d]),

  /** 12 000 */
  grouped(n) {
    return n < 10000 ? String(n) : String(n).replace(/\B(?=(\d{3})+$)/g, '\u00A0');
  },

  signed: (text) => text.replace(/-/g, '−'),

  scientific(mantissa, exponent) {
    return Numbers.signed(mantissa) + '·' + Numbers.raised('10^{' + exponent + '}');
  },

  /** A finite number in so many digits; a dash for others. */
  value(x, digits = 5) {
    if (!Number.isFinite(x)) return '–';
    if (x === 0) return '0';
    const rounded = Math.abs(Number(x.toPrecision(digits)));
    if (rounded >= 1e-3 && rounded < 1e5) {
      const text = x.toPrecision(digits);
      return Numbers.signed(text.includes('e') ? String(Number(text)) : text);
    }
    const [mantissa, exponent] = x.toExponential(digits - 1).split('e');
    return Numbers.scientific(mantissa, Number(exponent));
  },

  /** 10^x, which may be beyond the range of numbers. */
  powerOfTen(x, digits = 3) {
    if (x === -Infinity) return '0';
    if (!Number.isFinite(x)) return '–';
    let exponent = Math.floor(x);
    let mantissa = Math.pow(10, x - exponent).toFixed(digits - 1);
    if (mantissa.startsWith('10')) {
      ++exponent;
      mantissa = (1).toFixed(digits - 1);
    }
    return Numbers.scientific(mantissa, exponent);
  },

  /** The greatest of 1, 2, 5, 10, 20, … that is not above x > 0. */
  roundBelow(x) {
    const power = Math.pow(10, Math.floor(Math.log10(x)));
    return power * [5, 2, 1].find((digit) => digit * power <= x * (1 + 1e-9));
  },
};
