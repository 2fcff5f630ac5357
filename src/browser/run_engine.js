// The browser's program as a command of node.
'use strict';
const fs = require('fs');
const path = require('path');

const [folder, ...words] = process.argv.slice(2);
if (folder === undefined || folder === '-h' || folder === '--help') {
  console.log(`Usage: node run_engine.js FOLDER ARGUMENTS...
FOLDER holds engine.js and engine.wasm. Files and folders among the arguments are read from the disk; what the program writes stays
in memory.
Example: node src/browser/run_engine.js build/web run kepler --until 10`);
  process.exit(folder === undefined ? 2 : 0);
}
// Whoever reads may have read enough.
process.stdout.on('error', () => process.exit(0));

/** A file, or a folder with all that is in it. */
function copyInto(there, place) {
  const copy = path.resolve('/', place);
  if (fs.statSync(place).isDirectory()) {
    there.mkdirTree(copy);
    for (const name of fs.readdirSync(place)) copyInto(there, path.join(place, name));
  } else {
    there.mkdirTree(path.dirname(copy));
    there.writeFile(copy, fs.readFileSync(place));
  }
}

const makeEngine = require(path.resolve(folder, 'engine.js'));
makeEngine({
  wasmBinary: fs.readFileSync(path.join(folder, 'engine.wasm')),
  print: (line) => process.stdout.write(line + '\n'),
  printErr: (line) => process.stderr.write(line + '\n'),
  quit() {},
}).then((engine) => {
  for (const word of words) if (fs.existsSync(word)) copyInto(engine.FS, word);
  process.exitCode = engine.callMain(words);
});
