#!/usr/bin/env bash
# Everything that is promised of the device, checked on emulated boards, from a bare Debian machine or one with rustup:
# installs what is missing, builds, runs every board, compares with tables/ and the README. Prints a line a check; fails if
# one fails.
#
#   firmware/test.sh [--bless] [--keep FOLDER]
#
# --bless           accept the figures: writes tables/ and, with rustup's compiler, the README's table
# --keep FOLDER     leave the images there
# SCANRAY_TOOLCHAIN rustup or debian; unset takes rustup if it can provide the targets, else Debian's compiler
set -euo pipefail
cd "$(dirname "$0")"

targets=(thumbv7em-none-eabihf thumbv7m-none-eabi thumbv6m-none-eabi riscv32imc-unknown-none-elf)

# Installs the Debian packages of a command that is missing: `need COMMAND PACKAGE…`.
need() {
    local command=$1
    shift
    command -v "$command" >/dev/null && return
    if [ "$(id -u)" != 0 ] || ! command -v apt-get >/dev/null; then
        echo "$command is missing: install the Debian package $* (sudo apt-get install $*)" >&2
        exit 1
    fi
    echo "installing $*"
    if [ -z "${apt_lists_are_new:-}" ]; then
        apt-get -qq update
        apt_lists_are_new=1
    fi
    DEBIAN_FRONTEND=noninteractive apt-get -qq install -y --no-install-recommends "$@" >/dev/null
}

# Adds the targets that the toolchain in use has not got yet.
rustup_provides_targets() {
    command -v rustup >/dev/null || return 1
    local missing=()
    for target in "${targets[@]}"; do
        rustup target list --installed 2>/dev/null | grep -qx "$target" || missing+=("$target")
    done
    [ ${#missing[@]} = 0 ] || timeout 300 rustup target add "${missing[@]}" >/dev/null 2>&1
}

use_debian_toolchain() {
    need ld.lld lld
    # Another rustc may come first in PATH.
    [ -x /usr/bin/rustc ] && [ -d /usr/lib/rustlib/src/rust/library ] || need "Debian's rustc" rustc-web rust-web-src
    need cargo cargo-web
    export RUSTC=/usr/bin/rustc SCANRAY_BUILD_STD=1
    for target in "${targets[@]}"; do
        local name=${target^^}
        export "CARGO_TARGET_${name//-/_}_LINKER=ld.lld"
    done
}

need python3 python3
# Cargo fetches over TLS.
[ -n "${SSL_CERT_FILE:-}" ] || [ -e /etc/ssl/certs/ca-certificates.crt ] || need "certificates" ca-certificates
need qemu-system-arm qemu-system-arm
need qemu-system-riscv32 qemu-system-misc
need arm-none-eabi-objdump binutils-arm-none-eabi
need riscv64-unknown-elf-objdump binutils-riscv64-unknown-elf

toolchain=${SCANRAY_TOOLCHAIN:-}
if [ -z "$toolchain" ]; then
    if rustup_provides_targets; then toolchain=rustup; else toolchain=debian; fi
fi
case $toolchain in
    rustup)
        rustup_provides_targets || { echo "rustup cannot provide ${targets[*]}" >&2; exit 1; }
        need cc gcc libc6-dev
        ;;
    debian)
        need cc gcc libc6-dev
        use_debian_toolchain
        ;;
    *)
        echo "SCANRAY_TOOLCHAIN is '$toolchain': say rustup or debian" >&2
        exit 1
        ;;
esac
echo "compiler of $toolchain: $("${RUSTC:-rustc}" --version); $(qemu-system-arm --version | head -n 1)"

exec python3 tools/check.py "$@"
