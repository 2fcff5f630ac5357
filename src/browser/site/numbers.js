'use strict';

/// Numbers that the program wrote, of any size and length: 1.2345e-345.

/// The leading digits, as a number from 1 to 10, and the power of ten; null of 0 and of what is no number.
function leadingOf(text) {
  const parts = String(text).match(/^(-?)(\d+)(?:\.(\d+))?(?:e([-+]?\d+))?$/);
  if (!parts) return null;
  const [, sign, whole, fraction = '', exponent = '0'] = parts;
  const digits = whole + fraction, first = digits.search(/[1-9]/);
  if (first < 0) return null;
  return {
    sign, mantissa: Number(`${digits[first]}.${digits.slice(first + 1, first + 16)}`),
    power: Number(exponent) + whole.length - 1 - first,
  };
}

/// With two digits: 1.2e-345.
function shortNumber(text) {
  if (text === undefined || text === null) return '';
  const leading = leadingOf(text);
  if (!leading) return text !== '' && Number(text) === 0 ? '0' : String(text);
  const {sign, mantissa, power} = leading;
  return mantissa < 9.95 ? `${sign}${mantissa.toFixed(1)}e${power}` : `${sign}1.0e${power + 1}`;
}

/// Its logarithm to base 10; null where there is none.
function logarithmOf(text) {
  const leading = leadingOf(text);
  return leading && !leading.sign ? leading.power + Math.log10(leading.mantissa) : null;
}
