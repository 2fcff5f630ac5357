'use strict';

/// Round numbers: on axes, and as steps of what is moved.

/// The least and the greatest of numbers, apart from each other.
function endsOf(numbers) {
  const low = Math.min(...numbers), high = Math.max(...numbers);
  return low < high ? [low, high] : [low - (Math.abs(low) / 2 || 1), high + (Math.abs(high) / 2 || 1)];
}

/// The multiple of a unit that is nearest to x.
const multipleOf = (unit, x) => Number((Math.round(x / unit) * unit).toPrecision(12));

/// An axis from `low` to `high` with round numbers.
function axisOfNumbers([low, high], title) {
  const unit = Numbers.roundBelow((high - low) / 4), ticks = [];
  for (let i = Math.ceil(low / unit); i * unit <= high; ++i) {
    const value = multipleOf(unit, i * unit);
    ticks.push([value, Numbers.signed(String(value))]);
  }
  return {low, high, ticks, title};
}
