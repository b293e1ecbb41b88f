/* Explores an area of 15 by 15 cells without walls with a chain of 8 robots, and prints how many team moves that took. All memory
   is in this program; what goes wrong is told in words. */

#include <stdio.h>
#include <string.h>

#include "tautline.h"

#define ROBOTS 8
#define MOST_MOVES 1000

static int nothing_is_in_the_way(void *context, TautlineCell one, TautlineCell other) {
    (void)one;
    (void)other;
    ++*(unsigned *)context;
    return 1;
}

static int refused(const char *call, TautlineStatus status) {
    fprintf(stderr, "%s: %s\n", call, tautline_status_text(status));
    return 1;
}

int main(void) {
    static TautlineChain chain;
    static uint8_t log[MOST_MOVES * (ROBOTS - 1)];
    TautlineCell first = {0, 0}, last = {14, 14}, base = {7, 7};
    TautlineCell team[ROBOTS];
    TautlinePlan plan;
    TautlineStatus status;
    size_t bytes = 0, sent = 0, robots = 0;
    unsigned asked = 0, team_moves = 0;

    /* What is asked too early is refused. */
    if (tautline_chain_plan(&chain, log, 0, &plan) != TAUTLINE_STATUS_NOT_BEGUN) return 2;
    if (tautline_chain_begin(NULL, TAUTLINE_RULE_REPAIRED, ROBOTS, first, last, base) != TAUTLINE_STATUS_NULL_POINTER) return 2;
    if (tautline_chain_begin(&chain, 9, ROBOTS, first, last, base) != TAUTLINE_STATUS_UNKNOWN_RULE) return 2;
    if (tautline_chain_begin(&chain, TAUTLINE_RULE_REPAIRED, 1, first, last, base) != TAUTLINE_STATUS_TOO_FEW_ROBOTS) return 2;
    if (tautline_chain_begin(&chain, TAUTLINE_RULE_REPAIRED, 17, first, last, base) != TAUTLINE_STATUS_TOO_MANY_ROBOTS) return 2;
    if (tautline_chain_begin(&chain, TAUTLINE_RULE_REPAIRED, ROBOTS, last, first, base) != TAUTLINE_STATUS_BAD_AREA) return 2;

    status = tautline_chain_begin(&chain, TAUTLINE_RULE_REPAIRED, ROBOTS, first, last, base);
    if (status != TAUTLINE_STATUS_OK) return refused("tautline_chain_begin", status);
    if (tautline_chain_settle(&chain, nothing_is_in_the_way, &asked, log, ROBOTS, &sent) != TAUTLINE_STATUS_NO_PLAN) return 2;
    while ((status = tautline_chain_plan(&chain, log, bytes, &plan)) == TAUTLINE_STATUS_OK) {
        size_t room = sizeof log - bytes;
        if (tautline_chain_settle(&chain, nothing_is_in_the_way, &asked, log + bytes, 1, &sent) != TAUTLINE_STATUS_TOO_SMALL) return 2;
        status = tautline_chain_settle(&chain, nothing_is_in_the_way, &asked, log + bytes, room, &sent);
        if (status != TAUTLINE_STATUS_OK) return refused("tautline_chain_settle", status);
        bytes += sent;
        ++team_moves;
    }
    if (status != TAUTLINE_STATUS_EXPLORED) return refused("tautline_chain_plan", status);
    status = tautline_chain_cells(&chain, team, ROBOTS, &robots);
    if (status != TAUTLINE_STATUS_OK) return refused("tautline_chain_cells", status);
    for (int16_t y = 0; y < 15; ++y) {
        for (int16_t x = 0; x < 15; ++x) {
            uint8_t is_explored = 0;
            TautlineCell cell = {x, y};
            status = tautline_chain_is_explored(&chain, cell, &is_explored);
            if (status != TAUTLINE_STATUS_OK || !is_explored) return refused("tautline_chain_is_explored", status);
        }
    }
    printf("%u team moves, %zu robots, the leader at %d,%d\n", team_moves, robots, team[robots - 1].x,
           team[robots - 1].y);
    printf("%u edges tried, %zu bytes of messages, %zu bytes of memory\n", asked, bytes, sizeof chain);
    return 0;
}
