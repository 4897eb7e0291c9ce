#!/bin/sh
# set_up_environment.sh FOLDER REQUIREMENTS: a virtual environment with every pinned package and,
# editable, this one. FOLDER/ready is written last: it says that nothing is missing.
set -eu
folder=$1
requirements=$2
python=${PYTHON:-python3}

refuse() {
    echo "set-up: $1" >&2
    exit 2
}

command -v "$python" >/dev/null || refuse "no $python on the path; make PYTHON=/path/to/python3"
"$python" -c 'import sys; sys.exit(not (3, 10) <= sys.version_info[:2] <= (3, 13))' ||
    refuse "$("$python" -V) will not do, Python 3.10 to 3.13 is needed; make PYTHON=python3.12"
"$python" -c 'import ensurepip, venv' 2>/dev/null ||
    refuse "$python has no venv module; on Debian and Ubuntu: apt install python3-venv"

echo "Setting up $folder from $requirements (once, a minute or two) ..."
rm -f "$folder/ready"
"$python" -m venv "$folder"
# The package itself is built here (its build tools are pinned like the rest), so that nothing is
# fetched for it and it installs without a network, too. Python compiles a module when it is first
# imported: to compile all modules of all packages takes longer than to install them.
"$folder/bin/python" -m pip install --quiet --quiet --disable-pip-version-check --no-compile \
    -r "$requirements"
"$folder/bin/python" -m pip install --quiet --quiet --disable-pip-version-check \
    --no-deps --no-build-isolation --editable .
touch "$folder/ready"
