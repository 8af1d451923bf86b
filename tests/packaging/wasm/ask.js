// SPDX-License-Identifier: BSD-3-Clause
// Asks the module: node ask.js LIVE_FOLDER FILES_FOLDER < QUESTIONS. Each line is `{"open": inputs}`, with names of files
// below FILES_FOLDER, `{"verdicts": [states]}` or `{"reports": [states]}`; each answer is a line of JSON.
'use strict';
const fs = require('fs'), path = require('path'), readline = require('readline');
const [liveFolder, filesFolder] = process.argv.slice(2).map((name) => path.resolve(name));
const makeSweptLive = require(path.join(liveFolder, 'live.js'));

function copyFolder(to, folder, name) {
  const own = path.join(folder, name);
  if (!fs.statSync(own).isDirectory()) return to.writeFile('/' + name, fs.readFileSync(own));
  if (name) to.mkdirTree('/' + name);
  for (const entry of fs.readdirSync(own)) copyFolder(to, folder, path.posix.join(name, entry));
  return undefined;
}

async function main() {
  const module = await makeSweptLive({wasmBinary: fs.readFileSync(path.join(liveFolder, 'live.wasm'))});
  copyFolder(module.FS, filesFolder, '');
  function ask(what, state) {
    const room = module._malloc(8 * state.length);
    module.HEAPF64.set(state, room / 8);
    const answer = module.ccall('swept_live_' + what, 'string', ['number', 'number'], [room, state.length]);
    module._free(room);
    return JSON.parse(answer);
  }
  for await (const line of readline.createInterface({input: process.stdin})) {
    const question = JSON.parse(line), begin = performance.now();
    let answer;
    if (question.open) {
      module.FS.writeFile('/inputs.json', JSON.stringify(question.open));
      answer = JSON.parse(module.ccall('swept_live_open', 'string', ['string'], ['/inputs.json']));
    } else if (question.verdicts) {
      answer = {verdicts: question.verdicts.map((state) => ask('verdict', state).verdict)};
    } else {
      answer = {reports: question.reports.map((state) => ask('report', state))};
    }
    answer.seconds = (performance.now() - begin) / 1000;
    console.log(JSON.stringify(answer));
  }
}

main();
