(** Clauses whose certificates are accepted. The tables of each rule are what the kernel answers. *)
From Tautline Require Certificate.
From Tautline.generated Require CHAIN_1_repaired CHAIN_1_reel CHAIN_3_published CHAIN_3_uncovered CHAIN_3_reel
  CHAIN_19_reel CHAIN_22_reel KIT_1_repaired KIT_1_at_nodes KIT_2_repaired KIT_2_filtered KIT_3_repaired
  FRONTIER_2_plain FRONTIER_2_repaired PACK_2_published PACK_2_repaired.

Theorem CHAIN_1 : Certificate.holds CHAIN_1_repaired.rule_ /\ Certificate.holds CHAIN_1_reel.rule_.
Proof. exact (conj CHAIN_1_repaired.holds_ CHAIN_1_reel.holds_). Qed.
Theorem CHAIN_3 : Certificate.holds CHAIN_3_published.rule_ /\ Certificate.holds CHAIN_3_uncovered.rule_
  /\ Certificate.holds CHAIN_3_reel.rule_.
Proof. exact (conj CHAIN_3_published.holds_ (conj CHAIN_3_uncovered.holds_ CHAIN_3_reel.holds_)). Qed.
Theorem CHAIN_19 : Certificate.holds CHAIN_19_reel.rule_.
Proof. exact CHAIN_19_reel.holds_. Qed.
Theorem CHAIN_22_contact : Certificate.holds CHAIN_22_reel.rule_.
Proof. exact CHAIN_22_reel.holds_. Qed.
Theorem KIT_1 : Certificate.holds KIT_1_repaired.rule_ /\ Certificate.holds KIT_1_at_nodes.rule_.
Proof. exact (conj KIT_1_repaired.holds_ KIT_1_at_nodes.holds_). Qed.
Theorem KIT_2 : Certificate.holds KIT_2_repaired.rule_ /\ Certificate.holds KIT_2_filtered.rule_.
Proof. exact (conj KIT_2_repaired.holds_ KIT_2_filtered.holds_). Qed.
Theorem KIT_3 : Certificate.holds KIT_3_repaired.rule_.
Proof. exact KIT_3_repaired.holds_. Qed.
Theorem FRONTIER_2 : Certificate.holds FRONTIER_2_plain.rule_ /\ Certificate.holds FRONTIER_2_repaired.rule_.
Proof. exact (conj FRONTIER_2_plain.holds_ FRONTIER_2_repaired.holds_). Qed.
Theorem PACK_2 : Certificate.holds PACK_2_published.rule_ /\ Certificate.holds PACK_2_repaired.rule_.
Proof. exact (conj PACK_2_published.holds_ PACK_2_repaired.holds_). Qed.
