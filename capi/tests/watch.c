/* Watches four robots by each demand, and prints what each position brings. All memory is in this program. */

#include <stdio.h>

#include "tautline_monitor.h"

#define ROBOTS 4
#define GAP_US 1000000

/* Positions of the robots 0 to 3, in millimetres, at one moment each. */
static const int32_t MOMENTS[][ROBOTS][2] = {
    {{500, 500}, {1700, 500}, {2900, 500}, {4100, 500}},
    {{500, 500}, {2500, 500}, {4500, 500}, {6500, 500}},
    {{500, 500}, {2500, 500}, {4500, 500}, {7200, 500}},
    {{2500, 1700}, {2500, 3700}, {4500, 3700}, {2700, 3600}},
};

static const struct {
    const char *name;
    TautlineDemand demand;
} WATCHED[] = {
    {"neighbours", {TAUTLINE_DEMAND_NEIGHBOURS, 2549, 100, 0, 0, 0, 0}},
    {"joined", {TAUTLINE_DEMAND_JOINED, 2549, 100, 0, 0, 0, 0}},
    {"apart", {TAUTLINE_DEMAND_APART, 1000, 100, 0, 0, 0, 0}},
    {"cells", {TAUTLINE_DEMAND_CELLS, 1000, 100, 1, 1, 0, 0}},
};

static int refused(const char *call, TautlineStatus status) {
    fprintf(stderr, "%s: %s\n", call, tautline_status_text(status));
    return 1;
}

int main(void) {
    static TautlineMonitor monitor;
    static TautlineRobot robots[ROBOTS];
    TautlineVerdict verdict;
    TautlineDemand unknown = {9, 1, 0, 0, 0, 0, 0}, flat = {TAUTLINE_DEMAND_CELLS, 0, 0, 1, 0, 0, 0};
    TautlineDemand far = {TAUTLINE_DEMAND_NEIGHBOURS, 2549, 2549, 0, 0, 0, 0}, apart = {TAUTLINE_DEMAND_JOINED, 2549, 2549, 0, 0, 0, 0};
    TautlineDemand near = {TAUTLINE_DEMAND_APART, 3000, 3000, 0, 0, 0, 0}, wide = {TAUTLINE_DEMAND_CELLS, 1000, 500, 1, 0, 0, 0};

    /* What is asked too early, of nobody or for nothing is refused. */
    if (tautline_monitor_at(&monitor, 0, &verdict) != TAUTLINE_STATUS_NOT_BEGUN) return 2;
    if (tautline_monitor_begin(&monitor, NULL, GAP_US, robots, ROBOTS) != TAUTLINE_STATUS_NULL_POINTER) return 2;
    if (tautline_monitor_begin(&monitor, &unknown, GAP_US, robots, ROBOTS) != TAUTLINE_STATUS_BAD_DEMAND) return 2;
    if (tautline_monitor_begin(&monitor, &flat, GAP_US, robots, ROBOTS) != TAUTLINE_STATUS_BAD_DEMAND) return 2;
    if (tautline_monitor_begin(&monitor, &far, GAP_US, robots, ROBOTS) != TAUTLINE_STATUS_BAD_DEMAND) return 2;
    if (tautline_monitor_begin(&monitor, &apart, GAP_US, robots, ROBOTS) != TAUTLINE_STATUS_BAD_DEMAND) return 2;
    if (tautline_monitor_begin(&monitor, &near, GAP_US, robots, ROBOTS) != TAUTLINE_STATUS_BAD_DEMAND) return 2;
    if (tautline_monitor_begin(&monitor, &wide, GAP_US, robots, ROBOTS) != TAUTLINE_STATUS_BAD_DEMAND) return 2;
    if (tautline_monitor_begin(&monitor, &WATCHED[0].demand, GAP_US, robots, 0) != TAUTLINE_STATUS_TOO_FEW_ROBOTS) return 2;
    if (tautline_monitor_begin(&monitor, &WATCHED[0].demand, GAP_US, robots, (size_t)-1) != TAUTLINE_STATUS_TOO_MANY_ROBOTS) return 2;

    for (size_t watched = 0; watched < sizeof WATCHED / sizeof *WATCHED; ++watched) {
        TautlineStatus status = tautline_monitor_begin(&monitor, &WATCHED[watched].demand, GAP_US, robots, ROBOTS);
        if (status != TAUTLINE_STATUS_OK) return refused("tautline_monitor_begin", status);
        for (size_t moment = 0; moment < sizeof MOMENTS / sizeof *MOMENTS; ++moment) {
            uint64_t now_us = moment * GAP_US / 2;
            for (size_t robot = 0; robot < ROBOTS; ++robot) {
                const int32_t *place = MOMENTS[moment][robot];
                status = tautline_monitor_hear(&monitor, now_us, robot, now_us, place[0], place[1], &verdict);
                if (status != TAUTLINE_STATUS_OK) return refused("tautline_monitor_hear", status);
            }
            if (verdict.kind != TAUTLINE_VERDICT_BROKEN) continue;
            printf("%-10s at %.1f s: broken by %u and %u, %u where %u is allowed\n", WATCHED[watched].name, now_us / 1e6,
                   (unsigned)verdict.robots[0], (unsigned)verdict.robots[1], (unsigned)verdict.measured, (unsigned)verdict.allowed);
        }
        /* A position that is not taken hides no breach. */
        TautlineVerdict before = verdict;
        status = tautline_monitor_hear(&monitor, 0, ROBOTS, 0, 0, 0, &verdict);
        if (status != TAUTLINE_STATUS_OK) return 2;
        if (before.kind == TAUTLINE_VERDICT_BROKEN ? verdict.kind != before.kind : verdict.doubt != TAUTLINE_DOUBT_NOBODY) return 2;
        status = tautline_monitor_at(&monitor, 9 * GAP_US, &verdict);
        if (status != TAUTLINE_STATUS_OK || verdict.doubt != TAUTLINE_DOUBT_SILENT) return 2;
        status = tautline_monitor_hear(&monitor, 0, ROBOTS, 0, 0, 0, &verdict);
        if (status != TAUTLINE_STATUS_OK || verdict.doubt != TAUTLINE_DOUBT_NOBODY) return 2;
    }
    printf("%zu bytes for a monitor, %zu for each robot\n", sizeof monitor, sizeof *robots);
    return 0;
}
