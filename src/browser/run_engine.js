// The browser's program as a command of node.
'use strict';
const fs = require('fs');
const path = require('path');

const [folder, ...words] = process.argv.slice(2);
if (folder === undefined || folder === '-h' || folder === '--help') {
  console.log(`Usage: node run_engine.js FOLDER ARGUMENTS...
FOLDER holds engine.js and engine.wasm. Files among the arguments are read from the disk; what the program writes stays
in memory.
Example: node src/browser/run_engine.js build/web run kepler --until 10`);
  process.exit(folder === undefined ? 2 : 0);
}
// Whoever reads may have read enough.
process.stdout.on('error', () => process.exit(0));

const makeEngine = require(path.resolve(folder, 'engine.js'));
makeEngine({
  wasmBinary: fs.readFileSync(path.join(folder, 'engine.wasm')),
  print: (line) => process.stdout.write(line + '\n'),
  printErr: (line) => process.stderr.write(line + '\n'),
  quit() {},
}).then((engine) => {
  for (const word of words)
    if (fs.existsSync(word) && fs.statSync(word).isFile()) {
      const there = path.resolve('/', word);
      engine.FS.mkdirTree(path.dirname(there));
      engine.FS.writeFile(there, fs.readFileSync(word));
    }
  process.exitCode = engine.callMain(words);
});
