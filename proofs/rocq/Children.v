(** To which child an agent that searches in trees goes: BRICKS-13, for every number of children and however often they
    were entered; and how the kernel's answers agree. *)
From Coq Require Import Lia Bool List Arith.
From Tautline.generated Require Import TreesAnswers.
Import ListNotations.

(** Of children, each with how often it was entered, the first that was entered least. *)
Definition less (best child : nat * nat) : nat * nat := if snd child <? snd best then child else best.
Definition least (children : list (nat * nat)) : option nat :=
  match children with [] => None | child :: others => Some (fst (fold_left less others child)) end.

Lemma least_of_all : forall others child, In (fold_left less others child) (child :: others)
  /\ forall other, In other (child :: others) -> snd (fold_left less others child) <= snd other.
Proof.
  induction others as [|next others IH]; intros child; cbn [fold_left].
  - split; [now left|]. intros other [<-|[]]; reflexivity.
  - destruct (IH (less child next)) as [I L].
    assert (snd (less child next) <= snd child /\ snd (less child next) <= snd next) as [A B]
      by (unfold less; destruct (Nat.ltb_spec (snd next) (snd child)); lia).
    pose proof (L _ (or_introl eq_refl)) as F. split.
    + destruct I as [<-|I]; [|right; now right]. unfold less; destruct (snd next <? snd child); cbn; auto.
    + intros other [<-|[<-|O]]; [lia | lia | apply L; now right].
Qed.

Theorem BRICKS_13 : forall children c, least children = Some c ->
  exists k, In (c, k) children /\ forall d m, In (d, m) children -> k <= m.
Proof.
  intros [|child others] c E; [discriminate|]. injection E as <-. destruct (least_of_all others child) as [I L].
  exists (snd (fold_left less others child)). rewrite <- surjective_pairing. split; [exact I|].
  intros d m O; exact (L (d, m) O).
Qed.

(** The children of a cell in the order of the compass; 0 stands for a wall. *)
Definition agrees (goes : list (nat * nat) -> option nat) (answers : list (list nat * nat)) : bool :=
  forallb (fun a => match goes (filter (fun c => 0 <? snd c) (combine [1; 2; 3; 4] (fst a))) with
    | Some c => c =? snd a | None => 0 =? snd a end) answers.
Theorem child_answers_agree : agrees least children_tree = true /\ agrees least children_helpers = true
  /\ agrees (fun children => option_map fst (hd_error children)) children_helpers = false
  /\ length children_tree = 256 /\ length children_helpers = 256.
Proof. repeat split; vm_compute; reflexivity. Qed.
