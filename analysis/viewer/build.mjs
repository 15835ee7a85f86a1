// Makes dist/ of src/: a script, a shorter one for pages without a player, one style sheet, and the licences of what is in them. With --check it
// writes nothing and fails if dist/ differs.
import { createHash } from "node:crypto";
import { existsSync, readdirSync, readFileSync, mkdirSync, writeFileSync } from "node:fs";
import { dirname, join, relative } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const home = dirname(fileURLToPath(import.meta.url));

// tests/viewer/test_bundle.py computes the same without Node.
function sourcesHash() {
  const files = readdirSync(join(home, "src"), { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile() && /\.(js|css)$/.test(entry.name))
    .map((entry) => relative(home, join(entry.parentPath ?? entry.path, entry.name)));
  const hash = createHash("sha256");
  for (const file of [...files, "build.mjs", "package-lock.json"].sort()) {
    hash.update(`${file}\n`);
    hash.update(readFileSync(join(home, file)));
    hash.update("\n");
  }
  return hash.digest("hex");
}

// The licence of every package with a file in the bundle.
function licences(inputs) {
  const packages = [...new Set(Object.keys(inputs).map((path) =>
    /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(path)?.[1]).filter(Boolean))].sort();
  return packages.map((name) => {
    const folder = join(home, "node_modules", name);
    const about = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
    const file = readdirSync(folder).find((each) => /^licen[cs]e/i.test(each));
    if (!file) throw new Error(`${name} has no licence file: its text has to be in dist/LICENSES.txt`);
    return `${about.name} ${about.version} (${about.license})\n\n${readFileSync(join(folder, file), "utf8").trim()}\n`;
  }).join(`\n${"-".repeat(78)}\n\n`);
}

const result = await build({
  entryPoints: [{ in: join(home, "src/main.js"), out: "viewer" }, { in: join(home, "src/page.js"), out: "page" }],
  bundle: true, minify: true, write: false, metafile: true, outdir: join(home, "dist"), format: "iife", target: ["es2022"], charset: "ascii",
  legalComments: "none", logLevel: "warning", absWorkingDir: home });

const head = `/* bendlab viewer, sources ${sourcesHash()}; licences in LICENSES.txt */\n`;
const outputs = Object.fromEntries(result.outputFiles.map((file) => [relative(home, file.path), head + file.text]));
outputs["dist/LICENSES.txt"] = licences(result.metafile.inputs);

const check = process.argv.includes("--check");
mkdirSync(join(home, "dist"), { recursive: true });
for (const [path, text] of Object.entries(outputs)) {
  const file = join(home, path);
  if (!check) writeFileSync(file, text);
  else if (!existsSync(file) || readFileSync(file, "utf8") !== text) {
    console.error(`${path} is not made from the sources: npm run build`);
    process.exitCode = 1;
  }
  console.log(`${path}  ${(text.length / 1024).toFixed(0)} kB`);
}
