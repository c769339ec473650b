#!/usr/bin/env bash
# Installs the renderers that compare.py measures thinlens against: the system's packages with apt,
# the rest with pip into the Python that is in use (a virtual environment, best). Debian or Ubuntu;
# Python 3.11, the one that bpy 4.5 is built for.
set -euo pipefail
cd "$(dirname "$0")"

as_root() { if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo "$@"; fi; }

# Mitsuba's llvm variants load LLVM at run time. The X and GL libraries are what bpy is linked to.
as_root apt-get install -y povray libllvm19 libx11-6 libxext6 libxfixes3 libxi6 libxrender1 \
    libxkbcommon0 libsm6 libice6 libgl1
python3 -m pip install -r requirements.txt
