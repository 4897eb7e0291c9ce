#!/bin/sh
# Refresh the copy of three.js that a page of `truck-blowout view` carries:
#   scripts/vendor_three.sh [VERSION]
# Needs npm. Takes three and esbuild from the npm registry into a temporary folder and bundles the
# classes that report/viewer/page/*.js use into one minified script.
set -eu
version=${1:-0.187.0}
esbuild=0.28.2
target=$(cd "$(dirname -- "$0")/.." && pwd)/truck_blowout_sim/report/viewer/vendor
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp "$target/three.entry.js" "$work/entry.js"
cd "$work"
npm install --silent --no-save --no-audit --no-fund "three@$version" "esbuild@$esbuild"
npx esbuild entry.js --bundle --minify --format=iife --global-name=THREE --legal-comments=inline \
    --log-level=warning --outfile=three.min.js
cp three.min.js "$target/three.min.js"
cp node_modules/three/LICENSE "$target/three.LICENSE.txt"
cat > "$target/PROVENANCE.md" <<END
three.min.js: three $version from npm, bundled by esbuild $esbuild from three.entry.js
(scripts/vendor_three.sh). MIT license, three.LICENSE.txt. No line of it is changed.
sha256: $(sha256sum three.min.js | cut -d ' ' -f 1)
END
