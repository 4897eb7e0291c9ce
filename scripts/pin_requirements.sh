#!/bin/sh
# Writes requirements/<distribution>.txt: every package, pinned, for all supported Pythons in one
# file. Needs uv on the path. Run it after changing setup.py or a requirements/*.in.
set -eu
cd "$(dirname -- "$0")/.."
for distribution in kilted jazzy; do
    {
        echo "# Written by scripts/pin_requirements.sh from setup.py and requirements/$distribution.in."
        uv pip compile --quiet --universal --python-version 3.10 --no-header --no-emit-index-url \
            --no-emit-find-links --no-annotate --extra prove --extra test \
            setup.py "requirements/$distribution.in"
    } > "requirements/$distribution.txt.new"
    mv "requirements/$distribution.txt.new" "requirements/$distribution.txt"
done
# Only what the benchmarks and the documentation site need beyond the pins above.
for purpose in bench docs; do
    {
        echo "# Written by scripts/pin_requirements.sh from requirements/$purpose.in."
        uv pip compile --quiet --universal --python-version 3.10 --no-header --no-emit-index-url \
            --no-emit-find-links --no-annotate --constraint requirements/kilted.txt \
            "requirements/$purpose.in"
    } > "requirements/$purpose.txt"
done
