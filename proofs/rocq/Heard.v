(** CHAIN-8: one byte for each robot and team move is enough to know the state of the whole team.

    For every number of robots, every layout, every rule, every run, and every planner. A listener sees nothing of the
    world. It hears the bytes of R_2 ... R_N, and knows after each team move where the robots are, which edges are open,
    which are walls, what can be taken back, and whatever a planner that plans along remembers. No byte of a true run
    is refused. Replayed.v feeds the bytes of the kernel's runs to it. *)
From Coq Require Import ZArith NArith Lia Bool List Arith.
From Tautline Require Import Lattice Rule Team Base Message Replay.
Import ListNotations.

Definition word : Type := step * outcome.
Definition byte : Type := N.

(** A message survives its byte, and what is no message's byte is refused. *)
Definition is_message (m : word) : bool := match m with (Stay, Blocked) => false | _ => true end.
Theorem messages_survive_their_bytes : (forall m, is_message m = true -> decode (encode m) = Some m)
  /\ forall byte, (byte < 256)%N -> forall m, decode byte = Some m -> is_message m = true /\ encode m = byte.
Proof.
  split; [intros [[[]|] []] H; try discriminate; reflexivity|].
  intros byte L. set (fits := fun byte =>
    match decode byte with Some m => is_message m && (encode m =? byte)%N | None => true end).
  assert (forallb (fun k => fits (N.of_nat k)) (seq 0 256) = true) as A by (vm_compute; reflexivity).
  rewrite forallb_forall in A. specialize (A (N.to_nat byte)); rewrite in_seq, N2Nat.id in A.
  intros m D; unfold fits in A; rewrite D in A. specialize (A ltac:(lia)).
  apply andb_true_iff in A; destruct A as [A B]; split; [exact A | now apply N.eqb_eq].
Qed.

(** All that a team knows: where it is, open edges, what can be taken back; and walls. *)
Record known := { team_state : listed; met : list edge }.

Section Heard.
  Variables (N : nat) (rl : rule) (base : cell).

  Definition made_of (m : word) : step := match m with (_, Blocked) => Stay | (s, _) => s end.
  Definition at_edge (s : listed) (i : nat) (t : step) : list edge :=
    match t with Cross side => [edge_of (team_of (places s) i) side] | Stay => [] end.
  (** The edges where a wall was met, of those that robots tried: [l] is what R_2 ... R_N say. *)
  Definition walls_in (s : listed) (l : list word) : list edge :=
    flat_map (fun i => let m := nth (pred i) l (Stay, Arrived) in if is_blocked m then at_edge s i (fst m) else [])
      (seq 1 (pred N)).

  (** The state once robots have made these steps. *)
  Definition list_make (s : listed) (steps : list step) : listed :=
    let p := team_of (places s) in
    {| places := tabulate N (fun i => after (p i) (nth i steps Stay));
       opened := fold_left add (crossed N p (plan_of steps)) (opened s); made_so_far := steps :: made_so_far s |}.
  Definition list_unmake (s : listed) (steps : list step) (rest : list (list step)) : listed :=
    {| places := tabulate N (fun i => after (team_of (places s) i) (nth i steps Stay)); opened := opened s;
       made_so_far := rest |}.

  Definition apart (l m : list edge) : bool := forallb (fun e => negb (has m e)) l.

  (** What a listener knows after one team move, from the bytes alone. It refuses a byte that is no message, a team that
      does not agree on what the move was, a move taken back that is not the last one, and what cannot be of an edge. *)
  Definition hear (k : known) (sent : list byte) : option known :=
    let s := team_state k in
    match decoded sent with
    | None => None
    | Some l =>
        if forallb is_back l then
          match made_so_far s with
          | pl :: rest =>
              if list_eqb step_eqb (Stay :: map fst l) (tabulate N (undo (plan_of pl)))
              then Some {| team_state := list_unmake s (Stay :: map fst l) rest; met := met k |} else None
          | [] => None
          end
        else if existsb is_back l then None
        else
          let made := Stay :: map made_of l in
          let walls := walls_in s l in
          if apart (crossed N (team_of (places s)) (plan_of made)) (walls ++ met k) && apart walls (opened s)
          then Some {| team_state := list_make s made; met := fold_left add walls (met k) |} else None
    end.

  (** The world: what the robots say of a team move, and what is known after it. *)
  Variable walls : list edge.
  Definition says (s : listed) (m : team_move) (i : nat) : word :=
    match m with
    | Advance steps => let t := nth i steps Stay in
        (t, if arrives (stands walls) (team_of (places s) i) t then Arrived else Blocked)
    | Backtrack steps => (nth i steps Stay, TookBack)
    end.
  Definition sends (s : listed) (m : team_move) : list byte := map (fun i => encode (says s m i)) (seq 1 (pred N)).
  Definition learns (k : known) (m : team_move) (t : listed) : known :=
    {| team_state := t;
       met := match m with
         | Advance _ => fold_left add (walls_in (team_state k) (map (says (team_state k) m) (seq 1 (pred N)))) (met k)
         | Backtrack _ => met k
         end |}.

  Definition begins : known := {| team_state := list_start N base; met := [] |}.

  (** Runs: a planner [thinks] from what is known and what it remembers, and takes note of what it has heard. *)
  Variables (memory : Type) (fresh : memory).
  Variable thinks : known -> memory -> team_move * memory.
  Variable notes : memory -> list byte -> memory.

  Inductive true_run : known * memory -> list (list byte) -> Prop :=
  | true_start : true_run (begins, fresh) []
  | true_move : forall k mem sent m mem' t, true_run (k, mem) sent -> thinks k mem = (m, mem') ->
      next N rl base walls (team_state k) m = Some t ->
      List.length (match m with Advance l | Backtrack l => l end) = N ->
      true_run (learns k m t, notes mem' (sends (team_state k) m)) (sends (team_state k) m :: sent).

  (** A listener that plans along: it also refuses another team move than the planned one. *)
  Definition is_planned (m : team_move) (l : list word) : bool :=
    match m with
    | Advance steps => negb (forallb is_back l) && list_eqb step_eqb (tl steps) (map fst l)
    | Backtrack steps => forallb is_back l && list_eqb step_eqb (tl steps) (map fst l)
    end.
  Definition listens (x : known * memory) (sent : list byte) : option (known * memory) :=
    let '(m, mem') := thinks (fst x) (snd x) in
    match decoded sent with
    | Some l => if is_planned m l then option_map (fun k => (k, notes mem' sent)) (hear (fst x) sent) else None
    | None => None
    end.
  Fixpoint listens_to (x : known * memory) (sent : list (list byte)) : option (known * memory) :=
    match sent with
    | [] => Some x
    | one :: sent => match listens x one with Some y => listens_to y sent | None => None end
    end.
  Fixpoint hears (k : known) (sent : list (list byte)) : option known :=
    match sent with
    | [] => Some k
    | one :: sent => match hear k one with Some l => hears l sent | None => None end
    end.

  Hypothesis two_robots : 2 <= N.

  Lemma tabulate_cons : forall (A : Type) (f : nat -> A), tabulate N f = f 0 :: map f (seq 1 (pred N)).
  Proof. intros A f; unfold tabulate. destruct N; [lia | reflexivity]. Qed.
  Lemma tabulate_ext : forall (A : Type) (f g : nat -> A), (forall i, i < N -> f i = g i) ->
    tabulate N f = tabulate N g.
  Proof. intros A f g H; apply map_ext_in; intros i I; apply in_seq in I; apply H; lia. Qed.

  Lemma decoded_sends : forall s m, decoded (sends s m) = Some (map (says s m) (seq 1 (pred N))).
  Proof.
    intros s m; unfold sends; induction (seq 1 (pred N)) as [|i l IH]; [reflexivity|]. cbn [map decoded].
    rewrite IH, (proj1 messages_survive_their_bytes); [reflexivity|].
    destruct m as [steps|steps]; cbn; [|now destruct (nth i steps Stay)]. now destruct (nth i steps Stay).
  Qed.

  Lemma has_in : forall l e, has l e = true <-> In e l.
  Proof.
    intros l e; unfold has; rewrite existsb_exists; split; [intros [x [I E]]; apply edge_eqb_spec in E; now subst|].
    intros I; exists e; split; [exact I | now apply edge_eqb_spec].
  Qed.

  (** What holds of all that is known in a true run. *)
  Record is_true (k : known) : Prop := {
    can_be : reachable N rl base (stands walls) (state_of (team_state k));
    open_is_open : forall e, has (opened (team_state k)) e = true -> stands walls e = false;
    wall_is_wall : forall e, In e (met k) -> stands walls e = true;
    base_stayed : Forall (fun pl => plan_of pl 0 = Stay) (made_so_far (team_state k));
  }.

  Lemma sound_state : forall s, reachable N rl base (stands walls) (state_of s) ->
    forall e, has (opened s) e = true -> stands walls e = false.
  Proof.
    intros s [past R]; destruct (composition N rl base (stands walls) (fun _ => True) (fun _ _ => True))
      with (past := past) (st := state_of s) as [K _]; auto; lia.
  Qed.

  Lemma begins_true : is_true begins.
  Proof.
    split; cbn; try discriminate; try contradiction; [|constructor]. eexists; apply run_start, alike_start.
  Qed.

  Lemma walls_in_walls : forall s steps e,
    In e (walls_in s (map (says s (Advance steps)) (seq 1 (pred N)))) -> stands walls e = true.
  Proof.
    intros s steps e I; apply in_flat_map in I; destruct I as [i [I J]]; apply in_seq in I.
    rewrite nth_indep with (d' := says s (Advance steps) 0) in J by (rewrite map_length, seq_length; lia).
    rewrite map_nth, seq_nth in J by lia. replace (1 + pred i) with i in J by lia. unfold says in J.
    destruct (arrives _ _ _) eqn:A in J; cbn in J; [destruct J|]. unfold at_edge in J.
    destruct (nth i steps Stay) as [side|]; cbn in A, J; [|destruct J]. destruct J as [<-|[]].
    now destruct (stands walls _).
  Qed.

  Lemma advance_base : forall s steps t, next N rl base walls s (Advance steps) = Some t ->
    plan_of steps 0 = Stay /\ t = list_advance N walls s steps.
  Proof.
    intros s steps t X; cbn in X; destruct (admitted _ _ _ _ _) eqn:A; [|discriminate]; injection X as <-.
    split; [|reflexivity]. unfold admitted in A; rewrite !andb_true_iff in A; destruct A as [[[A _] _] _].
    unfold stays in A; now destruct (plan_of steps 0).
  Qed.

  Lemma made_heard : forall s steps, plan_of steps 0 = Stay ->
    Stay :: map made_of (map (says s (Advance steps)) (seq 1 (pred N)))
    = tabulate N (made (stands walls) (team_of (places s)) (plan_of steps)).
  Proof.
    intros s steps Z; rewrite tabulate_cons; f_equal; [unfold made; rewrite Z; reflexivity|].
    rewrite map_map; apply map_ext; intros i; unfold made, says, plan_of.
    destruct (arrives _ _ _); cbn; [now destruct (nth i steps Stay) | reflexivity].
  Qed.

  Lemma list_eqb_steps : forall a b, list_eqb step_eqb a b = true <-> a = b.
  Proof.
    induction a as [|x a IH]; intros [|y b]; cbn; try (split; [discriminate | discriminate]); [tauto|].
    rewrite andb_true_iff, IH. split; [intros [E ->]; f_equal; now destruct x as [[]|], y as [[]|]|].
    intros E; injection E as -> ->; split; [now destruct y as [[]|] | reflexivity].
  Qed.

  Lemma learns_true : forall k m t, is_true k -> next N rl base walls (team_state k) m = Some t ->
    is_true (learns k m t).
  Proof.
    intros k m t [R O W B] X. assert (reachable N rl base (stands walls) (state_of t)) as R'
      by (eapply next_reachable; eauto).
    split; cbn [learns team_state met]; auto.
    - now apply sound_state.
    - intros e I; destruct m as [steps|steps]; [|auto]. apply has_in in I; rewrite has_fold, orb_true_iff, !has_in in I.
      destruct I as [I|I]; [auto|]. eapply walls_in_walls; eauto.
    - destruct m as [steps|steps].
      + destruct (advance_base _ _ _ X) as [Z ->]; cbn; constructor; [|exact B].
        rewrite tabulate_cons; unfold plan_of, made; cbn. unfold plan_of in Z; rewrite Z; reflexivity.
      + cbn in X; destruct (made_so_far (team_state k)) as [|pl rest] eqn:M; [discriminate|].
        destruct (list_eqb _ _ _); [|discriminate]; injection X as <-; cbn. now inversion B.
  Qed.

  Lemma hears_one : forall k m t, is_true k -> next N rl base walls (team_state k) m = Some t ->
    hear k (sends (team_state k) m) = Some (learns k m t).
  Proof.
    intros k m t T X; pose proof (learns_true k m t T X) as [_ O W _]. destruct T as [R _ _ B].
    unfold hear; rewrite decoded_sends. set (l := map (says (team_state k) m) (seq 1 (pred N))).
    destruct m as [steps|steps].
    - destruct (advance_base _ _ _ X) as [Z ->].
      assert (forallb is_back l = false) as ->.
      { subst l; destruct (pred N) eqn:P; [lia|]. cbn. now destruct (arrives _ _ _). }
      assert (existsb is_back l = false) as ->.
      { subst l; induction (seq 1 (pred N)) as [|i r IH]; cbn; [reflexivity|]. rewrite IH.
        now destruct (arrives _ _ _). }
      subst l; rewrite made_heard by exact Z.
      change (list_make (team_state k) _) with (list_advance N walls (team_state k) steps).
      cbn [learns team_state met list_advance opened] in O, W |- *.
      assert (forall l m, (forall e, In e l -> In e m -> False) -> apart l m = true) as A.
      { intros l m D; apply forallb_forall; intros e I. destruct (has m e) eqn:H; [|reflexivity].
        apply has_in in H; destruct (D e I H). }
      rewrite !A; [reflexivity | |]; intros e I H; apply has_in in I.
      + apply has_in in I; apply walls_in_walls in I. apply has_in in H. rewrite O in I; [discriminate|].
        now rewrite has_fold, H.
      + assert (stands walls e = true) as Y.
        { apply in_app_iff in H; destruct H as [H|H]; [now apply walls_in_walls in H|].
          apply W, has_in. now rewrite has_fold, (proj2 (has_in _ _) H). }
        rewrite O in Y; [discriminate|]. now rewrite has_fold, I, orb_true_r.
    - cbn [next] in X. destruct (made_so_far (team_state k)) as [|pl rest] eqn:M; [discriminate|].
      destruct (list_eqb _ _ _) eqn:E; [|discriminate]; injection X as <-. apply list_eqb_steps in E; subst steps.
      assert (forallb is_back l = true) as -> by (subst l; induction (seq 1 (pred N)); cbn; auto).
      inversion B as [|? ? Z _]; subst.
      assert (Stay :: map fst l = tabulate N (undo (plan_of pl))) as ->.
      { subst l; rewrite tabulate_cons; f_equal; [unfold undo; now rewrite Z|]. rewrite map_map; apply map_ext_in.
        intros i I; apply in_seq in I; unfold says; cbn [fst].
        rewrite <- tabulate_cons, nth_tabulate by lia; reflexivity. }
      rewrite (proj2 (list_eqb_steps _ _) eq_refl). unfold learns, list_unmake, list_backtrack; cbn [team_state].
      do 3 f_equal. apply tabulate_ext; intros i L. rewrite nth_tabulate by exact L. unfold moved, made.
      pose proof (backtrack_meets_none N rl base (stands walls) ltac:(lia) (state_of (team_state k)) (plan_of pl)
        (map plan_of rest) R ltac:(cbn; now rewrite M) i L) as A. cbn [pos state_of] in A; now rewrite A.
  Qed.

  Lemma planned_one : forall s m t, List.length (match m with Advance l | Backtrack l => l end) = N ->
    next N rl base walls s m = Some t -> is_planned m (map (says s m) (seq 1 (pred N))) = true.
  Proof.
    intros s m t L X.
    assert (forall steps, List.length steps = N -> tl steps = map (fun i => nth i steps Stay) (seq 1 (pred N))) as T.
    { clear; intros [|x steps] L; cbn in L; subst; [reflexivity|]. cbn [tl pred]. rewrite <- seq_shift, map_map.
      cbn [nth]. clear; induction steps as [|y r IH]; cbn; [reflexivity|]. rewrite <- seq_shift, map_map. now f_equal. }
    destruct m as [steps|steps]; cbn [is_planned]; rewrite map_map; cbn [says fst]; apply andb_true_iff; split.
    - destruct (pred N) eqn:P; [lia|]. cbn. now destruct (arrives _ _ _).
    - apply list_eqb_steps; now apply T.
    - clear; induction (seq 1 (pred N)); cbn; auto.
    - apply list_eqb_steps; now apply T.
  Qed.

  Lemma hears_more : forall sent k k' one, hears k sent = Some k' -> hears k (sent ++ [one]) = hear k' one.
  Proof.
    induction sent as [|a sent IH]; intros k k' one E; cbn in *; [injection E as <-; now destruct (hear k one)|].
    destruct (hear k a); [eauto | discriminate].
  Qed.
  Lemma listens_more : forall sent x y one, listens_to x sent = Some y -> listens_to x (sent ++ [one]) = listens y one.
  Proof.
    induction sent as [|a sent IH]; intros x y one E; cbn [listens_to app] in *;
      [injection E as <-; now destruct (listens x one)|].
    destruct (listens x a); [eauto | discriminate].
  Qed.

  Theorem bytes_are_enough : forall x sent, true_run x sent ->
    hears begins (rev sent) = Some (fst x) /\ listens_to (begins, fresh) (rev sent) = Some x.
  Proof.
    intros x sent R. enough (is_true (fst x) /\ hears begins (rev sent) = Some (fst x)
      /\ listens_to (begins, fresh) (rev sent) = Some x) by tauto.
    induction R as [|k mem sent m mem' t R [T [H L]] D X E]; [split; [apply begins_true | split; reflexivity]|].
    cbn [fst rev] in *. split; [now apply learns_true|]. split.
    - erewrite hears_more by exact H. now apply hears_one.
    - erewrite listens_more by exact L. unfold listens; cbn [fst snd]; rewrite D, decoded_sends.
      rewrite (planned_one _ _ _ E X), (hears_one k m t T X). reflexivity.
  Qed.
End Heard.

(** CHAIN-8. Whoever hears the bytes of a run knows where the robots are, which edges are open and which are walls,
    and what can be taken back. If it plans along, it knows what the planner remembers. *)
Theorem CHAIN_8 : forall N rl base walls memory fresh thinks notes x sent, 2 <= N ->
  true_run N rl base walls memory fresh thinks notes x sent ->
  hears N (begins N base) (rev sent) = Some (fst x)
  /\ listens_to N memory thinks notes (begins N base, fresh) (rev sent) = Some x.
Proof. intros; eapply bytes_are_enough; eauto. Qed.

(** What is needed: by the steps alone, without the bit for a wall, a listener cannot tell where the leader is. *)
Theorem steps_alone_are_not_enough : exists m t t',
  next 2 REPAIRED (0, 0)%Z [] (list_start 2 (0, 0)%Z) m = Some t
  /\ next 2 REPAIRED (0, 0)%Z [((0, 0)%Z, true)] (list_start 2 (0, 0)%Z) m = Some t' /\ places t <> places t'.
Proof.
  exists (Advance [Stay; Cross East]); do 2 eexists; split; [reflexivity|].
  split; [reflexivity | discriminate].
Qed.
