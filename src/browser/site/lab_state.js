'use strict';

/// The state of the lab's controls, which its address holds:
/// {scene, text, set, methods, step, until, precision, reference, portrait}, in which any may be left out.

const labPrecisions = ['double', '34', '50', '100', '200'];

const labHash = (state) => '#' + encodeURIComponent(JSON.stringify(state));

/// The state of an address; {} of one without, or with one that is none.
function stateOfHash(hash) {
  try {
    return JSON.parse(decodeURIComponent(hash.slice(1))) ?? {};
  } catch {
    return {};
  }
}

/// The state that does what a command does; null of one that the lab cannot hold. `files` are texts that it reads.
function stateOfCommand([verb, ...words], files = {}) {
  const places = [], options = {};
  let into = places;
  for (const word of words)
    if (word.startsWith('--')) into = options[word] = [];
    else into.push(word);
  const several = verb === 'compare';
  const {[several ? '--methods' : '--method']: methods = ['hbvm:auto,3'], '--step': step = [], '--until': until = [],
    '--precision': [precision] = ['double'], [several ? '--reference' : '--error']: reference, ...others} = options;
  const known = several || verb === 'run';
  if (!known || places.length !== 1 || step.length > 1 || until.length !== 1 || reference?.length ||
      methods.some((name) => name.startsWith('tableau:')) || Object.keys(others).length ||
      !labPrecisions.includes(precision.replace('mpfr:', '')))
    return null;
  const [scene] = places;
  return {
    scene, ...(scene in files ? {text: files[scene]} : {}), methods, step: step[0] ?? '', until: until[0],
    precision: precision.replace('mpfr:', ''), reference: reference !== undefined,
  };
}
