# Sourced by the scripts beside it: they work from the root of the project and say how long each phase took.
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# phase TITLE COMMAND...
phase() {
    local title=$1 start=$SECONDS code=0
    shift
    echo "== $title"
    "$@" || code=$?
    if [[ $code -eq 0 ]]; then
        echo "== $title: $((SECONDS - start)) s"
    else
        echo "== $title: FAILED after $((SECONDS - start)) s" >&2
    fi
    echo
    return $code
}

# Shows the output of a command only if it fails.
quietly() {
    local log code=0
    log=$(mktemp)
    "$@" >"$log" 2>&1 || code=$?
    [[ $code -eq 0 ]] || cat "$log" >&2
    rm -f "$log"
    return $code
}

# build PRESET [TARGET...]
build() {
    local preset=$1
    shift
    cmake --build --preset "$preset" --parallel "$(nproc)" ${1:+--target "$@"}
}
