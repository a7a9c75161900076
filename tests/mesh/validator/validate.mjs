// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// node validate.mjs WRITER NODE_MODULES: runs WRITER in a folder of its own and checks every .glb
// and .gltf that it writes there with Khronos' validator: no error, no warning.

import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";

const [writer, modules] = process.argv.slice(2);
if (!existsSync(join(modules, "gltf-validator"))) {
  console.log(`SKIPPED: ${modules} has no gltf-validator (npm gets it when reports are built)`);
  process.exit(process.env.EXEMPLAR_BROWSER_TESTS === "required" ? 1 : 77);
}
const validator = createRequire(join(modules, "x.js"))("gltf-validator");

const kFewest = 30;
const kError = 0, kWarning = 1;
let failures = 0;

async function problems(bytes, file) {
  const report = await validator.validateBytes(new Uint8Array(bytes), {
    uri: file,
    maxIssues: 0,
    severityOverrides: {},
    externalResourceFunction: () => Promise.reject(new Error("no file names another one")),
  });
  return report.issues.messages.filter((m) => m.severity <= kWarning);
}

const folder = mkdtempSync(join(tmpdir(), "exemplar_gltf_validator_"));
try {
  execFileSync(writer, [folder], { stdio: "inherit" });
  const files = readdirSync(folder).sort();
  for (const file of files) {
    for (const m of await problems(readFileSync(join(folder, file)), file)) {
      const severity = m.severity === kError ? "error" : "warning";
      console.log(`${file}: ${severity} ${m.code} at ${m.pointer ?? m.offset}: ${m.message}`);
      ++failures;
    }
  }
  console.log(`${files.length} files, ${failures} errors and warnings`);
  if (files.length < kFewest) {
    console.log(`expected at least ${kFewest} files`);
    ++failures;
  }
  // The check can fail: a file whose normals are not of unit length.
  const normals = JSON.parse(readFileSync(join(folder, "box.gltf"), "utf8"));
  const accessor = normals.accessors[normals.meshes[0].primitives[0].attributes.NORMAL];
  accessor.bufferView = normals.meshes[0].primitives[0].attributes.POSITION;
  if ((await problems(Buffer.from(JSON.stringify(normals)), "broken.gltf")).length === 0) {
    console.log("positions in place of normals were not noticed");
    ++failures;
  }
} finally {
  rmSync(folder, { recursive: true, force: true });
}
process.exit(failures === 0 ? 0 : 1);
