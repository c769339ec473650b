#!/usr/bin/env bash
# Installs what thinlens needs beyond Rust, and only what is missing: a C++ compiler (glslang and
# imgui are built from source), the Vulkan loader, a software Vulkan device (lavapipe), the Khronos
# validation layer, the X libraries that the window loads at run time, and Xvfb, xdotool and xclip for the
# viewer's tests. Does nothing the second time.
set -euo pipefail
cd "$(dirname "$0")"

say() { printf 'setup: %s\n' "$*"; }
fail() { printf 'setup: %s\n' "$*" >&2; exit 1; }

as_root() {
    if [ "$(id -u)" -eq 0 ]; then
        "$@"
    elif command -v sudo >/dev/null; then
        sudo "$@"
    else
        fail "these packages need root and there is no sudo; run as root: $*"
    fi
}

# Reads package names, prints those for which the command "$@ NAME" fails.
missing() {
    local package
    while read -r package; do
        "$@" "$package" >/dev/null 2>&1 || echo "$package"
    done
}

apt_has() { [ "$(dpkg-query -W -f '${db:Status-Abbrev}' "$1" 2>/dev/null)" = 'ii ' ]; }

# The package list of one package manager, a name a line.
packages() {
    case "$1" in
        apt) printf '%s\n' g++ libvulkan1 mesa-vulkan-drivers vulkan-validationlayers \
            libx11-6 libx11-xcb1 libxcursor1 libxi6 libxrandr2 libxkbcommon0 libxkbcommon-x11-0 \
            libwayland-client0 xvfb xdotool xclip ;;
        dnf) printf '%s\n' gcc-c++ vulkan-loader mesa-vulkan-drivers vulkan-validation-layers \
            libX11 libX11-xcb libXcursor libXi libXrandr libxkbcommon libxkbcommon-x11 \
            libwayland-client xorg-x11-server-Xvfb xdotool xclip ;;
        pacman) printf '%s\n' gcc vulkan-icd-loader vulkan-swrast vulkan-validation-layers \
            libx11 libxcursor libxi libxrandr libxkbcommon libxkbcommon-x11 wayland \
            xorg-server-xvfb xdotool xclip ;;
        brew) printf '%s\n' vulkan-loader molten-vk vulkan-validationlayers ;;
    esac
}

install_missing() {
    local manager=$1 wanted
    shift
    wanted=$(packages "$manager" | missing "$@" | xargs)
    if [ -z "$wanted" ]; then
        say "nothing to install"
        return
    fi
    say "installing with $manager: $wanted"
    # The names are single words and meant to be split.
    # shellcheck disable=SC2086
    case "$manager" in
        apt)
            as_root env DEBIAN_FRONTEND=noninteractive apt-get update -qq
            as_root env DEBIAN_FRONTEND=noninteractive \
                apt-get install -y -qq --no-install-recommends $wanted >/dev/null
            ;;
        dnf) as_root dnf install -y -q $wanted ;;
        pacman) as_root pacman -S --needed --noconfirm $wanted ;;
        brew) brew install $wanted ;;
    esac
}

if command -v apt-get >/dev/null; then
    install_missing apt apt_has
elif command -v dnf >/dev/null; then
    install_missing dnf rpm -q
elif command -v pacman >/dev/null; then
    install_missing pacman pacman -Qi
elif command -v brew >/dev/null; then
    xcode-select -p >/dev/null 2>&1 || fail "no C++ compiler; run: xcode-select --install"
    install_missing brew brew list
else
    fail "no apt, dnf, pacman or brew here; install a C++ compiler, the Vulkan loader and a Vulkan 1.3 \
driver, the Khronos validation layer, Xvfb, xdotool and xclip by hand"
fi

needed=$(sed -n 's/^rust-version = "\(.*\)"/\1/p' Cargo.toml)
rustup_hint="install it with rustup: curl --proto '=https' --tlsv1.2 -sSf https://sh.rustup.rs | sh"
if ! command -v cargo >/dev/null && [ -x "${CARGO_HOME:-$HOME/.cargo}/bin/cargo" ]; then
    fail "cargo is installed but not on this shell's PATH; run: . ${CARGO_HOME:-$HOME/.cargo}/env"
fi
command -v cargo >/dev/null || fail "Rust is missing (thinlens needs $needed or newer); $rustup_hint"
have=$(cargo --version | awk '{print $2}')
oldest=$(printf '%s\n%s\n' "$needed" "${have%%-*}" | sort -V | head -n 1)
[ "$oldest" = "$needed" ] \
    || fail "Rust $have is too old (thinlens needs $needed or newer); run: rustup update stable"
say "ready (Rust $have)"
