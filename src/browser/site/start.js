'use strict';

/// The start of a scene, as the program tells it and moves it.

const file = 'scene.toml';

/// The start of a scene's text as a motion that begins with it, {motion, complaint}: by a step that moves nothing.
async function startOf(engine, text, more) {
  const words = ['run', file, '--method', 'rk4', '--step', '2^(-30)', '--until', '2^(-30)', '--plot', 'page.html'];
  const result = await engine.run([...words, ...more], {files: {[file]: text}, wanted: ['page.html']});
  const page = result.files['page.html'];
  // What is wrong with the run alone, is told by the run that was asked for.
  return {motion: page ? new Motion(dataOf(page)) : null,
    complaint: !page && result.err.includes(file) ? complaintOf(result) : ''};
}

/// The text with other numbers, {path: number}, moved to where the constraints hold: {text, complaint}.
/// Those in `held` stay as they are.
async function projected(engine, text, numbers, held) {
  const changed = new SceneText(text).with(numbers);
  if (changed === null) return {complaint: 'The text has no such numbers in a place of their own.'};
  const words = ['scene', 'project', file, ...held.flatMap((path) => ['--hold', path])];
  const result = await engine.run(words, {files: {[file]: changed}});
  return result.code === 0 ? {text: result.out + '\n', complaint: ''} : {complaint: complaintOf(result)};
}

/// Positions and velocities of bodies at the start, and how far a slider may move them: {path, number, reach}.
function startsOf(motion) {
  const axes = ['x', 'y', 'z'].slice(0, motion.dimension), states = motion.masses.map((place, k) =>
    ({name: motion.places[place].name, at: motion.position(place, 0), v: motion.velocity(k, 0)}));
  const reach = (vectors) => 2 * Math.max(...vectors.flat().map(Math.abs)) || 1;
  const apart = reach(states.map(({at}) => at)), speed = reach(states.map(({v}) => v));
  return states.flatMap(({name, at, v}) => [
    ...axes.map((axis, j) => ({path: `${name}.${axis}`, number: at[j], reach: apart})),
    ...axes.map((axis, j) => ({path: `${name}.v${axis}`, number: v[j], reach: speed})),
  ]);
}
