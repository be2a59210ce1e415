// tests/npm/validate_gltf.js FILE...: Khronos' glTF-Validator; one JSON line a file:
// {"file", "errors", "warnings", "messages": [{"code", "severity", "message", "pointer"}]}.
const fs = require('fs');
const path = require('path');
const validator = require('gltf-validator');

async function main() {
    for (const file of process.argv.slice(2)) {
        const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {
            uri: path.basename(file),
            maxIssues: 200,
            externalResourceFunction: (uri) => Promise.resolve(new Uint8Array(
                fs.readFileSync(path.join(path.dirname(file), decodeURIComponent(uri))))),
        });
        console.log(JSON.stringify({
            file, errors: report.issues.numErrors, warnings: report.issues.numWarnings,
            messages: report.issues.messages,
        }));
    }
}
main().catch((error) => { console.error(error); process.exit(1); });
