// SPDX-License-Identifier: MPL-2.0
// Prints the counts of Khronos' validator for one .glb: node gltf_validate.js FILE, with NODE_PATH at
// the folder of the npm package gltf-validator.
const fs = require('fs');
const validator = require('gltf-validator');
validator.validateBytes(new Uint8Array(fs.readFileSync(process.argv[2]))).then((report) => {
  console.log(JSON.stringify(report.issues));
});
