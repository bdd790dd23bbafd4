# Where the checkout, its build outputs and the PostgreSQL server are. Sourced by the scripts
# beside it, never run.
# shellcheck shell=bash
# Its variables are used by those scripts.
# shellcheck disable=SC2034

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
cd "$root" || exit

case ${CARGO_TARGET_DIR:-target} in
    /*) ;;
    *) CARGO_TARGET_DIR=$root/${CARGO_TARGET_DIR:-target} ;;
esac
export CARGO_TARGET_DIR
# What the scripts fetch for themselves.
tools=$root/.tools

# A login shell has rustup's folder on its PATH, a CI job often has not.
if ! command -v cargo >/dev/null && [ -x "${CARGO_HOME:-$HOME/.cargo}/bin/cargo" ]; then
    PATH=${CARGO_HOME:-$HOME/.cargo}/bin:$PATH
fi

# The scripts speak to their own clusters, by URL: what is set for another server must not leak in.
unset PGHOST PGHOSTADDR PGPORT PGUSER PGDATABASE PGPASSWORD PGPASSFILE PGSERVICE PGOPTIONS PGAPPNAME

# In CI the versions are those that were committed, or the build fails.
cargo_flags=(${CI:+--locked})

# The workspace, as arguments of cargo: always all of it, since cargo compiles a crate once for each choice of
# features that its neighbours make. Those of the extension depend on the server (find_server sets it).
workspace=()

release=$CARGO_TARGET_DIR/release
occlusion=$release/occlusion
# The same with item buffers of Embree, which scripts/build-embree makes.
occlusion_embree=$CARGO_TARGET_DIR/embree/occlusion

fail() {
    printf '%s: %s\n' "${0##*/}" "$*" >&2
    exit 1
}

# Sets pg_config, pg_major, bin_dir, stage and workspace, and tells pgrx about the server.
find_server() {
    local wanted=${PG_CONFIG:-/usr/lib/postgresql/15/bin/pg_config} version
    pg_config=$(command -v "$wanted") || fail "no pg_config at \"$wanted\": run scripts/setup or set PG_CONFIG"
    version=$("$pg_config" --version)
    pg_major=$(sed -n 's/^PostgreSQL \([0-9]*\).*/\1/p' <<<"$version")
    case $pg_major in
        14 | 15 | 16 | 17 | 18) ;;
        *) fail "PostgreSQL 14 to 18 is needed, \"$pg_config\" is \"$version\"" ;;
    esac
    bin_dir=$("$pg_config" --bindir)
    stage=$CARGO_TARGET_DIR/stage/pg$pg_major
    workspace=(--release "${cargo_flags[@]}" --workspace --no-default-features --features "pg_occlusion/pg$pg_major")
    export PGRX_PG_CONFIG_PATH=$pg_config
}

# The account that owns a private server: PostgreSQL refuses to run as root.
server_user() {
    if [ "$(id -u)" != 0 ]; then
        id -un
    elif id postgres >/dev/null 2>&1; then
        echo postgres
    else
        echo nobody
    fi
}

as_server_user() {
    if [ "$(id -u)" = 0 ]; then
        runuser -u "$(server_user)" -- "$@"
    else
        "$@"
    fi
}

# A temporary folder that the server's account can enter too. Not XDG_RUNTIME_DIR: that is memory,
# and a city does not belong there.
temporary_folder() {
    local folder=${TMPDIR:-/tmp}
    folder=${folder%/}
    as_server_user test -x "$folder" 2>/dev/null || folder=/tmp
    echo "$folder"
}

# Mesa's device chooser complains on machines without a desktop; the programs choose themselves.
export NODEVICE_SELECT=1
