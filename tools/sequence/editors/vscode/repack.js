// node repack.js F.vsix: the same files by their names and without the time, so that one commit makes one F.vsix. vsce's own modules.
"use strict";

const fs = require("fs");
const { buffer } = require("stream/consumers");
const ofVsce = (name) => require(require.resolve(name, { paths: [require.resolve("@vscode/vsce")] }));
const { promisify } = require("util");
const yauzl = ofVsce("yauzl");
const yazl = ofVsce("yazl");

async function contents(path) {
  const archive = await promisify(yauzl.open)(path, { lazyEntries: true, autoClose: false });
  const open = promisify(archive.openReadStream.bind(archive));
  const files = new Map();
  await new Promise((done, fail) => {
    archive.on("error", fail).on("end", done).on("entry", (entry) => {
      open(entry).then(buffer).then((data) => files.set(entry.fileName, data)).then(() => archive.readEntry(), fail);
    });
    archive.readEntry();
  });
  archive.close();
  return files;
}

async function main(path) {
  const files = await contents(path);
  const archive = new yazl.ZipFile();
  // The first day that a zip file knows, by its own clock, which has no zone.
  const mtime = new Date(1980, 0, 1);
  for (const name of [...files.keys()].sort()) archive.addBuffer(files.get(name), name, { mtime, mode: 0o100644 });
  archive.end();
  fs.writeFileSync(path, await buffer(archive.outputStream));
}

main(process.argv[2]);
