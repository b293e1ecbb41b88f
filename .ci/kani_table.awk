# Makes a table of what Kani (--output-format terse) prints, and fails unless it shows what is claimed. A harness named
# `holds` must be verified, and every `cover` in it satisfied: Kani succeeds without that. Every other harness is a
# mutant that must be rejected.

function complain(what) {
    faults[++count] = what
}

function finish() {
    if (harness == "") return
    must_hold = harness ~ /::holds$/
    verdict = result == "" ? "no verdict" : result
    if (result != "SUCCESSFUL") complain(harness ": " verdict)
    if (!must_hold && result == "SUCCESSFUL" && !panics) complain(harness ": it is not rejected")
    if (must_hold && covers == 0) complain(harness ": no cover is stated")
    if (must_hold && satisfied < covers) complain(harness ": only " satisfied " of " covers " covers satisfied")
    shown = must_hold ? satisfied " of " covers : "-"
    print "| `" harness "` | " (must_hold ? "hold" : "be rejected") " | " verdict " | " shown " |"
    holding += must_hold
    harness = result = ""
    covers = satisfied = panics = 0
}

BEGIN {
    print "| harness | must | verdict | covers |"
    print "| --- | --- | --- | --- |"
}

/^Checking harness / {
    finish()
    harness = $3
    sub(/\.\.\.$/, "", harness)
}

# ` ** 1 of 1 cover properties satisfied`
/^ *\*\* [0-9]+ of [0-9]+ cover properties satisfied/ {
    satisfied = $2
    covers = $4
}

/^VERIFICATION:- / {
    result = $2
    panics = /panics as expected/
}

/^Complete - / {
    summary = $0
    if ($(NF - 3) != 0) complain($(NF - 3) " harnesses failed")
}

END {
    finish()
    if (holding == 0) complain("no harness `holds` was run")
    if (summary == "") complain("Kani did not come to its end")
    print ""
    print summary
    for (fault = 1; fault <= count; fault++) print "- " faults[fault]
    exit count > 0
}
