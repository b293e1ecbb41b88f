/* Tautline's monitors of robots for programs in C: see docs/monitor.md. Written by cbindgen; a test
   compares it. */

#ifndef TAUTLINE_MONITOR_H
#define TAUTLINE_MONITOR_H

#include <stddef.h>
#include <stdint.h>
#include "tautline.h"

/*
 The size of a monitor in words of 8 bytes.
 */
#define TAUTLINE_MONITOR_WORDS 8

/*
 The size of a robot in words of 8 bytes.
 */
#define TAUTLINE_ROBOT_WORDS 5

/*
 CHAIN-3: robots whose numbers follow each other are at most `length_mm` apart.
 */
#define TAUTLINE_DEMAND_NEIGHBOURS 0

/*
 KIT-12, and of two robots KIT-1 and KIT-2: robots that are at most `length_mm` apart join all robots, directly or
 over others. Whether they did when they started, as KIT-12 asks, is not looked at.
 */
#define TAUTLINE_DEMAND_JOINED 1

/*
 KIT-3: robots that have left their starts are at least `length_mm` apart.
 */
#define TAUTLINE_DEMAND_APART 2

/*
 CHAIN-2, FRONTIER-2, PACK-2: at most `most` robots are in one cell of the width `length_mm`, but for a base.
 */
#define TAUTLINE_DEMAND_CELLS 3

/*
 Every robot was heard within the gap, and the clause is not broken.
 */
#define TAUTLINE_VERDICT_KEPT 0

/*
 The clause is broken, whatever the robots that were not heard do.
 */
#define TAUTLINE_VERDICT_BROKEN 1

/*
 The clause is not seen to be broken, but not enough is known.
 */
#define TAUTLINE_VERDICT_UNKNOWN 2

/*
 This robot was not heard yet, or not within the gap.
 */
#define TAUTLINE_DOUBT_SILENT 1

/*
 The stamp is before one of the same robot; the position was not taken.
 */
#define TAUTLINE_DOUBT_LATE 2

/*
 The stamp is further ahead of now than the gap; the position was not taken.
 */
#define TAUTLINE_DOUBT_AHEAD 3

/*
 There is no robot of this number; the position was not taken.
 */
#define TAUTLINE_DOUBT_NOBODY 4

/*
 The place is more than 1,000 km away; the position was not taken.
 */
#define TAUTLINE_DOUBT_TOO_FAR 5

/*
 A monitor and the memory that it needs. A caller reads and writes nothing in it.
 */
typedef struct {
  uint64_t mark;
  uint64_t memory[TAUTLINE_MONITOR_WORDS];
} TautlineMonitor;

/*
 A demand of positions. What it does not speak of is not read.
 */
typedef struct {
  /*
   One of `TAUTLINE_DEMAND_...`.
   */
  uint32_t kind;
  /*
   The range, the least distance, or the width of a cell, in millimetres.
   */
  uint32_t length_mm;
  /*
   How far off a distance, or a position in cells, may be: less than the
   range, the least distance, or half the width of a cell.
   */
  uint32_t tolerance_mm;
  /*
   The most robots in a cell.
   */
  uint32_t most;
  /*
   Any other number than 0 if there is a base, a cell in which any number may be.
   */
  uint32_t has_base;
  /*
   The column of the base.
   */
  int32_t base_column;
  /*
   The row of the base.
   */
  int32_t base_row;
} TautlineDemand;

/*
 The memory of one robot. A caller reads and writes nothing in it.
 */
typedef struct {
  uint64_t memory[TAUTLINE_ROBOT_WORDS];
} TautlineRobot;

/*
 The answer of a monitor.
 */
typedef struct {
  /*
   One of `TAUTLINE_VERDICT_...`.
   */
  uint32_t kind;
  /*
   The reason of an unknown verdict, one of `TAUTLINE_DOUBT_...`; else 0.
   */
  uint32_t doubt;
  /*
   Two of the robots that break the clause, from 0, or one that breaks it alone
   twice; of a silent robot, or of one that there is not, its number first.
   */
  uint32_t robots[2];
  /*
   The distance in millimetres, or the robots in the cell, of a broken clause.
   */
  uint32_t measured;
  /*
   The most or the least that the clause allows, without the tolerance.
   */
  uint32_t allowed;
} TautlineVerdict;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/*
 Makes a monitor in the caller's memory that has heard none of the `count` robots, whose memory is `robots` and stays
 where it is. A position that is older than `gap_us` microseconds is no longer believed.

 # Safety
 `monitor` and `robots` are null, or memory of the caller that nobody else uses as long as the monitor is used, of
 one monitor and of so many robots; `demand` is null or can be read.
 */
TautlineStatus tautline_monitor_begin(TautlineMonitor *monitor,
                                      const TautlineDemand *demand,
                                      uint64_t gap_us,
                                      TautlineRobot *robots,
                                      size_t count);

/*
 Takes the position of `robot`, from 0, stamped `at_us` microseconds, and writes to `verdict` what the monitor says
 of the moment `now_us` by the same clock. A stamp further ahead of now than the gap is not believed.

 # Safety
 `monitor` and `verdict` are null, or memory of the caller that nobody else uses meanwhile.
 */
TautlineStatus tautline_monitor_hear(TautlineMonitor *monitor,
                                     uint64_t now_us,
                                     size_t robot,
                                     uint64_t at_us,
                                     int32_t x_mm,
                                     int32_t y_mm,
                                     TautlineVerdict *verdict);

/*
 Writes to `verdict` what the monitor says of the moment `now_us`, if nobody was heard for a while.

 # Safety
 As of `tautline_monitor_hear`.
 */
TautlineStatus tautline_monitor_at(TautlineMonitor *monitor, uint64_t now_us, TautlineVerdict *verdict);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* TAUTLINE_MONITOR_H */
