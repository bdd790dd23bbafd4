# What the tests share that kill a server. Sourced by them, after environment.sh, never run.
# shellcheck shell=bash
# bin_dir is of environment.sh.
# shellcheck disable=SC2154

# psql on a cluster, printing bare values; it stops at the first error.
sql() {
    PGOPTIONS='-c client_min_messages=warning' \
        "$bin_dir/psql" -XAtq -v ON_ERROR_STOP=1 "$(scripts/cluster url "$1")" "${@:2}"
}

# Waits until a command prints something, half a minute at most.
wait_for() {
    local tries
    for ((tries = 0; tries < 300; tries++)); do
        [ -z "$("$@" 2>/dev/null)" ] || return 0
        sleep 0.1
    done
    fail "waited in vain for: $*"
}

# The process id of a cluster's postmaster.
postmaster_of() {
    head -n 1 "$1/data/postmaster.pid"
}

# Waits until processes are gone, whoever's children they are; two minutes at most.
wait_until_gone() {
    local process tries
    for process in "$@"; do
        for ((tries = 0; tries < 2400; tries++)); do
            kill -0 "$process" 2>/dev/null || continue 2
            sleep 0.05
        done
        fail "process $process does not end"
    done
}

# Kills all processes of a cluster's server, all at once and without a chance to write anything down.
kill_server() {
    local postmaster children
    postmaster=$(postmaster_of "$1")
    # Held, it makes no process that would be missing in the list, and would keep the next server from starting.
    kill -STOP "$postmaster"
    mapfile -t children < <(pgrep -P "$postmaster")
    kill -9 "$postmaster"
    kill -9 "${children[@]}" 2>/dev/null || true # some may be gone already
    wait_until_gone "$postmaster" "${children[@]}"
}

# Kills the postmaster alone. Its children end when they notice, a busy one after its statement.
kill_postmaster() {
    local postmaster children
    postmaster=$(postmaster_of "$1")
    kill -STOP "$postmaster"
    mapfile -t children < <(pgrep -P "$postmaster")
    kill -9 "$postmaster"
    wait_until_gone "$postmaster" "${children[@]}"
}
