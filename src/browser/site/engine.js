'use strict';

/// The program in a worker, one instance a command. `hbvmEngine`, of engine_data.js, has its script and its module.
/// Everything is in the page's own files: nothing is asked for from elsewhere, and a page opened as a file works, too.
class Engine {
  /// The compiled module; made once, as soon as engine_data.js is there.
  static module() {
    Engine.compiled ??= (async () => {
      if (document.readyState !== 'complete') await new Promise((loaded) => window.addEventListener('load', loaded));
      const packed = Uint8Array.from(atob(hbvmEngine.module), (c) => c.charCodeAt(0));
      const unpacked = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
      return WebAssembly.compile(await new Response(unpacked).arrayBuffer());
    })();
    return Engine.compiled;
  }

  /// Runs `hbvm words...`. `files` maps names to texts that are there before; those named in `wanted` are read after it.
  /// progress(line) is called with what the program's bar says.
  /// Resolves to {code, out, err, files}; a stopped command has the code 130, also one that has not begun.
  run(words, {files = {}, wanted = [], progress = () => {}} = {}) {
    return new Promise((resolve) => {
      const result = (code, err) => resolve({code, out: '', err, files: {}});
      let stopped = false;
      this.stop = () => {
        stopped = true;
        result(130, 'stopped');
      };
      Engine.module().then((module) => {
        if (stopped) return;
        const script = new Blob([hbvmEngine.script, '\n', `(function ${Engine.inWorker})()`], {type: 'text/javascript'});
        const address = URL.createObjectURL(script);
        const worker = new Worker(address);
        const end = () => {
          worker.terminate();
          URL.revokeObjectURL(address);
          this.stop = () => {};
        };
        this.stop = () => {
          end();
          result(130, 'stopped');
        };
        worker.onmessage = ({data}) => {
          if (data.progress !== undefined) return progress(data.progress);
          end();
          resolve(data);
        };
        worker.onerror = (event) => {
          end();
          result(1, `hbvm: ${event.message}`);
        };
        worker.postMessage({module, words, files, wanted});
      }).catch((error) => result(1, `hbvm: ${error.message}`));
    });
  }

  stop() {}

  /// What runs in the worker; makeEngine() stands before it.
  static inWorker() {
    onmessage = async ({data: {module, words, files, wanted}}) => {
      const out = [], err = [];
      const program = await makeEngine({
        instantiateWasm(imports, receive) {
          WebAssembly.instantiate(module, imports).then(receive);
          return {};
        },
        print: (line) => out.push(line),
        printErr: (line) => err.push(line),
        quit() {},
      });
      // The bar ends its lines with a carriage return, at which the library's terminal would wait for more.
      const bytes = [];
      const line = (last) => {
        const text = new TextDecoder().decode(new Uint8Array(bytes.splice(0))).replace(/\x1b\[[0-9;]*[A-Za-z]/g, '');
        if (last === 13) postMessage({progress: text.trim()});
        else if (text.trim()) err.push(text);
      };
      const terminal = program.FS.streams[2].tty;
      terminal.ops = {
        put_char(tty, code) {
          if (code === 10 || code === 13) line(code);
          else bytes.push(code);
        },
        flush() {},
      };
      for (const [name, text] of Object.entries(files)) program.FS.writeFile(name, text);
      let code = 1;
      try {
        code = program.callMain(words);
      } catch (error) {
        err.push(`hbvm: ${error}`);
      }
      line(10);
      const results = {};
      for (const name of wanted)
        if (program.FS.analyzePath(name).exists) results[name] = program.FS.readFile(name, {encoding: 'utf8'});
      postMessage({code, out: out.join('\n'), err: err.join('\n'), files: results});
    };
  }
}
