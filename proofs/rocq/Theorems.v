(** The statements of all theorems, a line [Check] for each. `make` asks behind them what they rest on: on no assumption
    but the definitions; and compares what is printed with audit.expected. *)
From Coq Require Import ZArith QArith List.
From Tautline Require Import Lattice Rule Plane Team Contact Base Crowding Coverage Rings Unfolding.
From Tautline Require Heard Reach ChainEnds Reel Scripts ReelTie Admission AdmissionTie Epochs EpochsTie Hold Marking
  Notice Kit Mrc Leases Replay Mutants MrcMutants ChainTie Replayed NoticeTie
  MrcTie KitTie Local LocalChain Certificate Certified Ants Frontier Spread SpreadTie Machines Choices Asking Records
  Ways MachinesTie Homing HomingTie Refined
  Explorers ExplorersEnd ExplorersKeep ExplorersTie AntsTie ExplorersMutants ExplorersEndless Pack PackTie Trees TreesEnd
  TreesAlone TreesOne TreesTie AloneTie
  Labels Turns Children Fixes FixesTie
  Sides Joint JointEnds JointTie Entering Fused FusedTie Patience PatienceTie.
Local Open Scope nat_scope.
Set Printing Width 110.

(** What `make` makes of the lines below, to ask about all at once. *)
Inductive proofs := none | also {P : Prop} (one : P) (others : proofs).
Notation "one ;; others" := (also one others) (at level 60, right associativity).

(** The clauses. *)
Check LATTICE_1.
Check CHAIN_1.
Check CHAIN_2.
Check CHAIN_3.
Check CHAIN_3_towards_a_wall.
Check Admission.CHAIN_4.
Check Admission.admits_plan_spec.
Check CHAIN_5.
Check marking_is_enough.
Check CHAIN_6.
Check backtrack_meets_no_wall.
Check Heard.CHAIN_8.
Check Heard.messages_survive_their_bytes.
Check CHAIN_10.
Check CHAIN_13_step.
Check Reach.CHAIN_13.
Check Reach.within_reach_is_reachable.
Check Reel.CHAIN_7.
Check Reel.CHAIN_17.
Check Reel.CHAIN_18.
Check Reel.CHAIN_23.
Check Scripts.each_habit_is_needed.
Check Epochs.CHAIN_7.
Check Epochs.unfolding_arrives.
Check Epochs.epochs_must_gain.
Check Hold.CHAIN_19.
Check Hold.hold_keeps_coverage.
Check Hold.admitted_is_held.
Check Hold.held_is_repaired.
Check Marking.BRICKS_2_marking.
Check Notice.NOTICE_1.
Check Notice.NOTICE_2.
Check Spread.NOTICE_3.
Check Spread.NOTICE_4.
Check Spread.NOTICE_5.
Check Spread.NOTICE_6.
Check Leases.MRC_1.
Check Leases.MRC_2.
Check Leases.MRC_4.
Check Leases.MRC_8.
Check Choices.MRC_3.
Check Records.MRC_6.
Check Asking.MRC_7.
Check Choices.MRC_9.
Check Records.MRC_10.
Check Ways.MRC_11.
Check Records.MRC_12.
Check Asking.MRC_13.
Check Records.MRC_14.
Check Homing.TAN_1.
Check Homing.TAN_2.
Check Homing.TAN_4.
Check Patience.TAN_3.
Check Patience.the_first_of_the_strongest.
Check Kit.KIT_1.
Check Kit.KIT_3.
Check Kit.KIT_12.
Check Kit.arrivals_keep_admitted.
Check Sides.KIT_10.
Check Sides.covered_at_both_ends.
Check Joint.KIT_11.
Check Joint.KIT_14.
Check Joint.two_keep_in_touch.
Check JointEnds.KIT_6_drives.
Check JointEnds.KIT_7_drives.
Check JointEnds.KIT_8_knows.
Check Explorers.FRONTIER_1.
Check Entering.FRONTIER_2.
Check ExplorersEnd.FRONTIER_3.
Check ExplorersEnd.plain_in_the_end_ends.
Check ExplorersKeep.keeping_ends.
Check ExplorersKeep.repaired_keeping.
Check ExplorersKeep.FRONTIER_3.
Check Explorers.FRONTIER_4.
Check Explorers.FRONTIER_5.
Check Fixes.FRONTIER_6.
Check Fixes.FRONTIER_7.
Check Fused.FRONTIER_10.
Check ExplorersOnce.FRONTIER_13.
Check Fused.no_two_in_one_cell.
Check Ants.ANTS_1.
Check Ants.ANTS_2.
Check Ants.ANTS_3.
Check Pack.PACK_1.
Check Pack.PACK_2.
Check Pack.PACK_6.
Check Trees.BRICKS_2.
Check Turns.BRICKS_3.
Check Trees.BRICKS_4.
Check Trees.BRICKS_8.
Check Trees.BRICKS_9.
Check TreesEnd.BRICKS_5.
Check TreesEnd.BRICKS_6.
Check TreesEnd.BRICKS_11.
Check TreesOne.BRICKS_10.
Check TreesAlone.BRICKS_12.
Check Children.BRICKS_13.
Check Labels.BRICKS_14.

(** What each condition is needed for. *)
Check Mutants.published_breaks_CHAIN_1.
Check Mutants.published_breaks_CHAIN_2.
Check Mutants.without_SafeAhead_breaks_CHAIN_1.
Check Mutants.without_CoveredBehind_breaks_CHAIN_1.
Check Mutants.without_UnsureAhead_breaks_CHAIN_1.
Check Mutants.without_Distinct_breaks_CHAIN_2.
Check Mutants.without_FullForFollower_breaks_CHAIN_2.
Check Mutants.without_FullForLeader_breaks_CHAIN_2.
Check Mutants.without_SafeAhead_breaks_CHAIN_3.
Check Heard.steps_alone_are_not_enough.
Check Hold.unsure_ahead_does_not_hold.
Check Notice.without_FrozenOnceForwarded_breaks_NOTICE_1.
Check Spread.k_of_one_breaks_NOTICE_5.
Check Spread.published_breaks_NOTICE_4.
Check MrcMutants.without_ChoiceStands_breaks_MRC_1.
Check MrcMutants.without_Epochs_breaks_MRC_2.
Check MrcMutants.without_Consent_breaks_MRC_4.
Check Choices.each_condition_is_needed_for_MRC_3.
Check Choices.without_AnswersAgain_breaks_MRC_9.
Check Choices.without_room_breaks_MRC_9.
Check Asking.each_condition_is_needed_for_MRC_7.
Check Records.without_Epochs_breaks_MRC_10.
Check Records.without_room_breaks_MRC_10_and_MRC_12.
Check Ways.without_room_breaks_MRC_11.
Check Homing.a_liar_breaks_TAN_2.
Check Patience.other_numbers_break_TAN_3.
Check Kit.without_NextInReach_breaks_KIT_1.
Check Kit.without_FromInReach_breaks_KIT_1.
Check Kit.without_Apart_breaks_KIT_3.
Check Sides.without_Marked_breaks_KIT_10.
Check Sides.others_alone_break_KIT_10.
Check Joint.any_path_breaks_KIT_11.
Check Ants.counting_is_needed.
Check Ants.an_end_of_misses_is_needed.
Check Ants.published_breaks_ANTS_3.
Check ExplorersMutants.without_Route_breaks_FRONTIER_1.
Check ExplorersMutants.without_Return_breaks_FRONTIER_13.
Check ExplorersEndless.without_Keep_breaks_FRONTIER_3.
Check Pack.published_breaks_PACK_1.
Check Fixes.without_its_bound_FRONTIER_6_breaks.
Check Fixes.without_its_bound_FRONTIER_7_breaks.
Check Fused.at_its_bound_FRONTIER_10_breaks.
Check Fused.beyond_its_bound_FRONTIER_10_breaks.
Check Fused.without_the_share_FRONTIER_10_breaks.
Check Trees.without_Childless_breaks_BRICKS_2.
Check TreesEnd.without_Exit_breaks_BRICKS_6.
Check Turns.without_turns_breaks_BRICKS_3.
Check Labels.too_few_bits_break_BRICKS_14.

(** The tie to the kernel. *)
Check ChainTie.chain_answers_agree.
Check ChainTie.every_question_is_in_the_table.
Check ChainTie.kernel_answers_as_the_relation.
Check Replay.replay_reachable.
Check Replayed.kernel_runs_are_runs.
Check Replayed.kernel_runs_are_heard.
Check ChainEnds.kernel_runs_end.
Check AdmissionTie.plans_are_accepted.
Check EpochsTie.kernel_epochs_run.
Check ReelTie.kernel_reels_run.
Check NoticeTie.notice_answers_agree.
Check SpreadTie.spread_agrees.
Check SpreadTie.numbered_agrees.
Check MrcTie.mrc_answers_agree.
Check MachinesTie.machine_answers_agree.
Check MachinesTie.ways_agree.
Check Refined.robots_are_refined.
Check Refined.wfrs_are_refined.
Check HomingTie.homing_answers_agree.
Check HomingTie.guide_answers_agree.
Check PatienceTie.kernel_walks_agree.
Check KitTie.kit_answers_agree.
Check KitTie.every_drive_is_in_the_table.
Check JointTie.joint_runs_agree.
Check JointTie.kernel_runs_are_runs.
Check JointTie.areas_are_closed.
Check ExplorersTie.kernel_runs_are_runs.
Check FixesTie.fix_answers_agree.
Check FusedTie.fused_answers_agree.
Check AntsTie.ants_answers_agree.
Check AntsTie.kernel_ants_run.
Check AntsTie.floors_are_floors.
Check PackTie.pack_answers_agree.
Check PackTie.kernel_runs_are_runs.
Check TreesTie.kernel_trees_run.
Check AloneTie.kernel_helpers_run.
Check AloneTie.kernel_helpers_alone.
Check Labels.label_answers_agree.
Check Children.child_answers_agree.
Check TreesTie.four_moves_are_not_enough_for_brick_tree.
Check TreesTie.two_moves_are_not_enough_for_brick_tree.

(** Any local rule. *)
Check Local.every_N.
Check Local.check_inductive.
Check LocalChain.any_neighbours_keep_contact.
Check LocalChain.each_condition_is_needed.

(** Certificates of local rules. *)
Check Certificate.sound.
Check Certified.CHAIN_1.
Check Certified.CHAIN_3.
Check Certified.CHAIN_19.
Check Certified.CHAIN_22_contact.
Check Certified.KIT_1.
Check Certified.KIT_2.
Check Certified.KIT_3.
Check Certified.FRONTIER_2.
Check Certified.PACK_2.

(** A model that nothing ties to the kernel. *)
Check Frontier.no_two_in_one_cell.
Check Frontier.every_run_ends.
Check Frontier.never_stuck.
Check Frontier.all_that_is_joined_is_explored.
