(** What is proved, and from what: for each theorem its statement, and that it rests on no assumption but the definitions.

    `make` compares what this file prints with audit.expected. *)
From Coq Require Import ZArith QArith List.
From Tautline Require Import Lattice Rule Team Contact Base Crowding Coverage Rings Unfolding Hold Marking Notice Kit Mrc Leases
  Replay Mutants MrcMutants ChainTie Replayed NoticeTie MrcTie KitTie.
Set Printing Width 110.

(** The clauses. *)
Check LATTICE_1.
Print Assumptions LATTICE_1.
Check CHAIN_1.
Print Assumptions CHAIN_1.
Check CHAIN_2.
Print Assumptions CHAIN_2.
Check CHAIN_3.
Print Assumptions CHAIN_3.
Check CHAIN_3_towards_a_wall.
Print Assumptions CHAIN_3_towards_a_wall.
Check CHAIN_6.
Print Assumptions CHAIN_6.
Check backtrack_meets_no_wall.
Print Assumptions backtrack_meets_no_wall.
Check CHAIN_10.
Print Assumptions CHAIN_10.
Check CHAIN_13_step.
Print Assumptions CHAIN_13_step.
Check hold_keeps_contact.
Print Assumptions hold_keeps_contact.
Check hold_keeps_coverage.
Print Assumptions hold_keeps_coverage.
Check BRICKS_2_marking.
Print Assumptions BRICKS_2_marking.
Check NOTICE_1.
Print Assumptions NOTICE_1.
Check MRC_1.
Print Assumptions MRC_1.
Check MRC_2.
Print Assumptions MRC_2.
Check MRC_4.
Print Assumptions MRC_4.
Check MRC_6.
Print Assumptions MRC_6.
Check MRC_8.
Print Assumptions MRC_8.
Check KIT_1.
Print Assumptions KIT_1.
Check KIT_3.
Print Assumptions KIT_3.
Check KIT_12.
Print Assumptions KIT_12.

(** What each condition is needed for. *)
Check published_breaks_CHAIN_1.
Print Assumptions published_breaks_CHAIN_1.
Check published_breaks_CHAIN_2.
Print Assumptions published_breaks_CHAIN_2.
Check without_SafeAhead_breaks_CHAIN_1.
Print Assumptions without_SafeAhead_breaks_CHAIN_1.
Check without_CoveredBehind_breaks_CHAIN_1.
Print Assumptions without_CoveredBehind_breaks_CHAIN_1.
Check without_UnsureAhead_breaks_CHAIN_1.
Print Assumptions without_UnsureAhead_breaks_CHAIN_1.
Check without_Distinct_breaks_CHAIN_2.
Print Assumptions without_Distinct_breaks_CHAIN_2.
Check without_FullForFollower_breaks_CHAIN_2.
Print Assumptions without_FullForFollower_breaks_CHAIN_2.
Check without_FullForLeader_breaks_CHAIN_2.
Print Assumptions without_FullForLeader_breaks_CHAIN_2.
Check without_SafeAhead_breaks_CHAIN_3.
Print Assumptions without_SafeAhead_breaks_CHAIN_3.
Check unsure_ahead_does_not_hold.
Print Assumptions unsure_ahead_does_not_hold.
Check without_FrozenOnceForwarded_breaks_NOTICE_1.
Print Assumptions without_FrozenOnceForwarded_breaks_NOTICE_1.
Check without_ChoiceStands_breaks_MRC_1.
Print Assumptions without_ChoiceStands_breaks_MRC_1.
Check without_Epochs_breaks_MRC_2.
Print Assumptions without_Epochs_breaks_MRC_2.
Check without_Consent_breaks_MRC_4.
Print Assumptions without_Consent_breaks_MRC_4.
Check without_NextInReach_breaks_KIT_1.
Print Assumptions without_NextInReach_breaks_KIT_1.
Check without_FromInReach_breaks_KIT_1.
Print Assumptions without_FromInReach_breaks_KIT_1.
Check without_Apart_breaks_KIT_3.
Print Assumptions without_Apart_breaks_KIT_3.

(** The tie to the kernel. *)
Check chain_answers_agree.
Print Assumptions chain_answers_agree.
Check every_question_is_in_the_table.
Print Assumptions every_question_is_in_the_table.
Check kernel_answers_as_the_relation.
Print Assumptions kernel_answers_as_the_relation.
Check replay_reachable.
Print Assumptions replay_reachable.
Check kernel_runs_are_runs.
Print Assumptions kernel_runs_are_runs.
Check notice_answers_agree.
Print Assumptions notice_answers_agree.
Check mrc_answers_agree.
Print Assumptions mrc_answers_agree.
Check kit_answers_agree.
Print Assumptions kit_answers_agree.
Check every_drive_is_in_the_table.
Print Assumptions every_drive_is_in_the_table.

